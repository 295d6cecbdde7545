#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// What data and a prior leave open of parameters. It is decomposed, without
// squaring the data, in coordinates in which the prior is 1, so that directions
// that only the prior determines stay exact beside data that are a million
// times sharper, and no variance comes out negative.
class Posterior {
 public:
  // A: rows x parameters, A'A is the information of the data; prior: that of
  // the prior. Parameters not `kept` are known, their rows and columns of
  // results 0. Where there is no prior, one of 10^10 times a parameter's
  // deviation alone stands for it.
  Posterior(const Eigen::MatrixXd& A, const Eigen::MatrixXd& prior,
            const std::vector<int>& kept);

  // (A'A + prior)^-1
  Eigen::MatrixXd Gain() const;
  // Gain() F'F Gain()', positive semidefinite whatever the rounding.
  Eigen::MatrixXd Sandwich(const Eigen::MatrixXd& F) const;

 private:
  Eigen::MatrixXd T_;  // parameters x directions
  Eigen::VectorXd shrink_;
};

// F with F'F = A, A positive semidefinite but for rounding.
Eigen::MatrixXd SquareRoot(const Eigen::MatrixXd& A);

// G A G', symmetric and positive semidefinite to rounding of its variances
// even where G A is far larger.
Eigen::MatrixXd Sandwich(const Eigen::MatrixXd& G, const Eigen::MatrixXd& A);

}  // namespace armcal
