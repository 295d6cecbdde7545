#include "calib/logs/position_noise.h"

#include <cmath>
#include <vector>

#include "calib/numerics/median.h"

namespace armcal {
namespace {

constexpr int kOrder = 5;
// Of a standard normal: a deviation over the median of absolute values; and of
// its differences of that order: the variance, 10 over 5.
constexpr double kOverMedian = 1.4826;
constexpr double kVariance = 252;

}  // namespace

Eigen::VectorXd PositionNoise(const Eigen::MatrixXd& q) {
  if (q.rows() <= kOrder) return Eigen::VectorXd::Zero(q.cols());
  Eigen::MatrixXd d = q;
  for (int k = 0; k < kOrder; ++k) {
    d = (d.bottomRows(d.rows() - 1) - d.topRows(d.rows() - 1)).eval();
  }
  Eigen::VectorXd noise(q.cols());
  for (int j = 0; j < q.cols(); ++j) {
    std::vector<double> sizes;
    for (const double x : d.col(j)) {
      if (x != 0) sizes.push_back(std::abs(x));
    }
    noise[j] = kOverMedian * Median(std::move(sizes)) / std::sqrt(kVariance);
  }
  return noise;
}

}  // namespace armcal
