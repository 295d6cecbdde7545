#pragma once

#include <Eigen/Core>

namespace armcal {

// An autoregression of order 3 of a joint's noise, whose innovations have the
// standard deviation `sigma`.
struct ResidualNoise {
  static constexpr int kOrder = 3;
  Eigen::Vector3d a = Eigen::Vector3d::Zero();
  double sigma = 1;

  // By the Yule-Walker equations from a series of mean zero.
  static ResidualNoise Fit(const Eigen::VectorXd& series);
  // (x_t - a1 x_{t-1} - a2 x_{t-2} - a3 x_{t-3}) / sigma for each column of x;
  // the first kOrder rows, which lack their past, are left out.
  Eigen::MatrixXd Whiten(const Eigen::MatrixXd& x) const;
};

}  // namespace armcal
