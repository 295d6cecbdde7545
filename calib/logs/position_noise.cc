#include "calib/logs/position_noise.h"

#include <algorithm>
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

struct Difference {
  double size;   // of order kOrder, rad or m
  double moved;  // between its first and last sample
};

// Keeps so many of those that moved least.
void KeepSlowest(std::size_t kept, std::vector<Difference>* all) {
  if (kept >= all->size()) return;
  std::nth_element(all->begin(), all->begin() + static_cast<long>(kept),
                   all->end(), [](const Difference& a, const Difference& b) {
                     return a.moved < b.moved;
                   });
  all->resize(kept);
}

}  // namespace

Eigen::VectorXd PositionNoise(const Eigen::MatrixXd& q, double slowest) {
  return PositionNoise(q, std::vector<double>{slowest});
}

Eigen::MatrixXd PositionNoise(const Eigen::MatrixXd& q,
                              const std::vector<double>& slowest) {
  const auto shares = static_cast<Eigen::Index>(slowest.size());
  Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(q.cols(), shares);
  if (q.rows() <= kOrder) return noise;
  Eigen::MatrixXd d = q;
  for (int k = 0; k < kOrder; ++k) {
    d = (d.bottomRows(d.rows() - 1) - d.topRows(d.rows() - 1)).eval();
  }
  for (int j = 0; j < q.cols(); ++j) {
    std::vector<Difference> moving;
    for (Eigen::Index k = 0; k < d.rows(); ++k) {
      if (d(k, j) == 0) continue;
      moving.push_back(
          {std::abs(d(k, j)), std::abs(q(k + kOrder, j) - q(k, j))});
    }
    const auto all = static_cast<double>(moving.size());
    for (Eigen::Index s = 0; s < shares; ++s) {
      KeepSlowest(static_cast<std::size_t>(std::ceil(slowest[s] * all)),
                  &moving);
      std::vector<double> sizes;
      for (const Difference& one : moving) sizes.push_back(one.size);
      noise(j, s) =
          kOverMedian * Median(std::move(sizes)) / std::sqrt(kVariance);
    }
  }
  return noise;
}

}  // namespace armcal
