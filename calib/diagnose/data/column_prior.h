#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// Whether data tell a parameter, of whose variance before them this share is
// left: I being their information on it, in units of the prior's,
// 1 / (1 + I) is, and they tell more of it than the prior does where I > 1.
inline bool IsToldByData(double variance_left) {
  return 1 / variance_left - 1 > 1;
}

// What is known of a baseline's columns before the logs. Each is standard
// normal and independent of the others, but for those that something tells
// together, such as a calibration:
//   x_w ~ N(mean, C),   x_k ~ N(0, 1) for all others.
class ColumnPrior {
 public:
  ColumnPrior() = default;
  // `which` ascend; about 0, with this covariance, positive semidefinite.
  ColumnPrior(std::vector<int> which, const Eigen::MatrixXd& covariance);

  const std::vector<int>& which() const { return which_; }
  // From now on columns are counted from these values of all of them on.
  void MoveZeroTo(const Eigen::VectorXd& x) { mean_ -= x(which_); }

  // Of the first `columns`, among which all that are told together are: the
  // inverse covariance, and that times the mean.
  Eigen::MatrixXd Precision(int columns) const;
  Eigen::VectorXd PrecisionTimesMean(int columns) const;
  // r(x) of independent standard normal entries: minus twice the logarithm of
  // the prior's density is |r|^2 and a constant.
  Eigen::VectorXd Residual(const Eigen::VectorXd& x) const;
  double Stddev(int column) const;

 private:
  std::vector<int> which_;
  Eigen::VectorXd mean_, stddev_;
  Eigen::MatrixXd root_;  // U, with U'U = C^-1
};

}  // namespace armcal
