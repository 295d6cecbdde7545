#pragma once

#include <Eigen/Core>
#include <deque>
#include <vector>

namespace armcal {

// One row of every joint's equations in a fit. U: n x parameters; r: residuals
// in units of their noise, weighed by the loss, 0 where the equation is not
// used; inside: whether the loss is quadratic there.
struct FittedRow {
  Eigen::MatrixXd U;
  Eigen::VectorXd r;
  std::vector<bool> used, inside;
};

// The covariance of an estimate x = gain * sum of scale_i u_i' r_i if errors
// follow each other only where rows overlap: from the products of the rows
// themselves and each joint's error autocovariances at the lags within a
// window. Much less noisy than what Newey-West makes of a short log, but blind
// to errors that last longer or are larger at some times.
class OverlapCovariance {
 public:
  OverlapCovariance(int num_joints, int num_parameters, int rows_per_window);

  void Add(const FittedRow& row);
  void Break();  // the next row does not follow the last
  // `scale` turns a joint's row times its residual into a score.
  Eigen::MatrixXd Value(const Eigen::MatrixXd& gain,
                        const Eigen::VectorXd& scale) const;

 private:
  const Eigen::MatrixXd& Square(int i, int d) const {
    return squares_[i * distances_ + d];
  }
  Eigen::MatrixXd Taken(const Eigen::MatrixXd& gain,
                        const Eigen::VectorXd& scale, const Eigen::MatrixXd& c,
                        const Eigen::MatrixXd& covariance) const;

  int lags_, distances_;
  Eigen::VectorXd rows_, inside_;
  Eigen::MatrixXd products_;  // joint x lag: sums of r(t) r(t - lag)
  // Joint, distance: sums of u(t)' u(t - d).
  std::vector<Eigen::MatrixXd> squares_;
  std::deque<FittedRow> recent_;
};

// Standard deviations of `covariance` raised to those of variances `least`.
Eigen::MatrixXd RaiseTo(const Eigen::VectorXd& least,
                        const Eigen::MatrixXd& covariance);

}  // namespace armcal
