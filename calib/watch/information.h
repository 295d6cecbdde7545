#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// A Gaussian over the errors of the calibrated parameters.
struct ParameterBelief {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

// The normal equations of a stretch of whitened rows A z = r: A'A and A'r. The
// columns are the parameters' and then the six of a wrench on the last link.
struct RowInformation {
  explicit RowInformation(int columns)
      : AtA(Eigen::MatrixXd::Zero(columns, columns)),
        Atr(Eigen::VectorXd::Zero(columns)) {}

  // Rows (a row per joint) with one weight each, 1 / variance.
  void Add(const Eigen::MatrixXd& rows, const Eigen::VectorXd& r,
           const Eigen::VectorXd& weight);
  void Add(const RowInformation& other);

  Eigen::MatrixXd AtA;
  Eigen::VectorXd Atr;
  double begin = 0, end = 0;  // s, of the rows
  long rows = 0;
};

// A change that parameters or an outside force may make: z = columns theta with
// theta ~ N(0, stddev^2), independent of each other.
struct WatchHypothesis {
  enum class Kind { kPayload, kFriction, kContact };
  Kind kind = Kind::kPayload;
  int joint = -1;           // of friction, from 0
  Eigen::MatrixXd columns;  // of RowInformation, a column per theta
  Eigen::VectorXd stddev;
  std::vector<std::string> names, units;  // of theta
};

// What rows say of one hypothesis against no change.
struct ChangeEvidence {
  double log_bayes = 0;  // log p(rows | change) / p(rows | none)
  // The same of the estimate theta alone, whatever its prior: how much better
  // it fits.
  double log_likelihood = 0;
  Eigen::VectorXd theta;
  Eigen::MatrixXd covariance;  // of theta
};

// What a stretch of rows says of changes since `belief`, which is what was
// known of the parameters before; its errors are integrated out.
class ChangeTest {
 public:
  ChangeTest(const RowInformation& rows, const ParameterBelief& belief,
             const Eigen::MatrixXd& root);

  ChangeEvidence Of(const WatchHypothesis& change) const;

 private:
  Eigen::MatrixXd AtA_;
  Eigen::VectorXd Atr_;   // of what the belief's mean leaves
  Eigen::MatrixXd half_;  // see the source
  Eigen::VectorXd half_r_;
};

// C with C C' = the covariance, which may be singular.
Eigen::MatrixXd CovarianceRoot(const Eigen::MatrixXd& covariance);

// The belief once the rows (their columns of parameters) are known as well, and
// by how much they make p(rows) larger or smaller does not matter.
ParameterBelief Updated(const ParameterBelief& belief,
                        const RowInformation& rows);

}  // namespace armcal
