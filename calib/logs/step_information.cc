#include "calib/logs/step_information.h"

#include <algorithm>
#include <utility>

namespace armcal {

using Eigen::VectorXd;

StepInformation::StepInformation(const Log& log)
    : steps_(FitVelocityLaws(log)) {
  for (size_t j = 0; j < steps_.laws.size(); ++j) {
    if (steps_.laws[j].usable) joints_.push_back(static_cast<int>(j));
  }
  variance_ = VectorXd::Ones(steps_.v.cols());
  if (joints_.size() < 2) return;
  EstimateNoise();
  has_groups_ = MakeGroups();
}

TimeSums StepInformation::Sums(const std::vector<int>& joints,
                               Eigen::Index k) const {
  TimeSums sums;
  for (const int j : joints) {
    const double v = steps_.v(k, j) / variance_[j];
    sums.product += v * steps_.change(k, j);
    sums.square += v * steps_.v(k, j);
  }
  sums.by_stamp = sums.square * steps_.dt[k];
  return sums;
}

// The variance of each joint's dq beside the steps that all joints tell, so
// that it is not the clock's. A joint's own share in these is given back: its
// residual has 1 - v_j^2 / s_j^2 / (sum of all) of its variance.
void StepInformation::EstimateNoise() {
  constexpr int kRounds = 5;
  for (const int j : joints_) {
    variance_[j] = steps_.change.col(j).squaredNorm() / size() + 1e-300;
  }
  for (int round = 0; round < kRounds; ++round) {
    VectorXd squares = VectorXd::Zero(variance_.size()), free = squares;
    for (Eigen::Index k = 0; k < size(); ++k) {
      const TimeSums sums = Sums(joints_, k);
      if (!(sums.square > 0)) continue;
      for (const int j : joints_) {
        const double v = steps_.v(k, j);
        const double left = steps_.change(k, j) - v * sums.step();
        squares[j] += left * left;
        free[j] += 1 - v * v / variance_[j] / sums.square;
      }
    }
    for (const int j : joints_) {
      // What is exact would have all of the weight.
      const double least = 1e-12 * steps_.change.col(j).squaredNorm() / size();
      variance_[j] = squares[j] / std::max(free[j], 1.) + least + 1e-300;
    }
  }
}

// The joint that tells most first, each to the group that knows less.
bool StepInformation::MakeGroups() {
  std::vector<std::pair<double, int>> order;
  for (const int j : joints_) {
    const double square = steps_.v.col(j).cwiseProduct(steps_.dt).squaredNorm();
    order.emplace_back(-square / variance_[j], j);
  }
  std::sort(order.begin(), order.end());
  std::array<double, 2> known = {0, 0};
  for (const auto& [information, j] : order) {
    const int to = known[0] > known[1] ? 1 : 0;
    groups_[to].push_back(j);
    known[to] -= information;
  }
  return known[0] > 0 && known[1] > 0;
}

}  // namespace armcal
