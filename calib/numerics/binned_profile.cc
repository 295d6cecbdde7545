#include "calib/numerics/binned_profile.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

constexpr double kFinest = 1.0 / (1 << 20);
constexpr double kMostIndex = 1e15;  // that a double still counts exactly

long FloorHalf(long k) { return k >= 0 ? k / 2 : -((1 - k) / 2); }

}  // namespace

BinnedProfile::BinnedProfile(int num_signals, int most_bins)
    : num_signals_(num_signals), most_bins_(most_bins), width_(kFinest) {
  CHECK_GE(most_bins, 2);
}

void BinnedProfile::Add(double x, const Eigen::VectorXd& values) {
  CHECK_EQ(values.size(), num_signals_);
  CHECK(std::isfinite(x));
  while (std::abs(x / width_) > kMostIndex) Halve();
  long at = static_cast<long>(std::floor(x / width_));
  if (empty()) first_ = at;
  while (std::max(at, first_ + size() - 1) - std::min(at, first_) >=
         most_bins_) {
    Halve();
    at = FloorHalf(at);
  }
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(num_signals_);
  const long before = std::max(0L, first_ - at);
  first_ -= before;
  const long after = std::max(0L, at + 1 - first_ - size() - before);
  for (auto* list : {&sums_, &squares_}) {
    list->insert(list->begin(), before, zero);
    list->insert(list->end(), after, zero);
  }
  samples_.insert(samples_.begin(), before, 0);
  samples_.insert(samples_.end(), after, 0);
  const long bin = at - first_;
  ++samples_[bin];
  sums_[bin] += values;
  squares_[bin] += values.cwiseAbs2();
}

Eigen::VectorXd BinnedProfile::Mean(int bin) const {
  return sums_[bin] / static_cast<double>(samples_[bin]);
}

Eigen::VectorXd BinnedProfile::Rms(int bin) const {
  return (squares_[bin] / static_cast<double>(samples_[bin])).cwiseSqrt();
}

void BinnedProfile::Halve() {
  const long first = FloorHalf(first_);
  std::vector<long> samples;
  std::vector<Eigen::VectorXd> sums, squares;
  for (int k = 0; k < size(); ++k) {
    const size_t bin = FloorHalf(first_ + k) - first;
    if (bin == samples.size()) {
      samples.push_back(samples_[k]);
      sums.push_back(sums_[k]);
      squares.push_back(squares_[k]);
      continue;
    }
    samples[bin] += samples_[k];
    sums[bin] += sums_[k];
    squares[bin] += squares_[k];
  }
  samples_ = std::move(samples);
  sums_ = std::move(sums);
  squares_ = std::move(squares);
  first_ = first;
  width_ *= 2;
}

}  // namespace armcal
