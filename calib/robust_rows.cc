#include "calib/robust_rows.h"

#include <algorithm>
#include <cmath>

#include "problems/robust_loss.h"

namespace armcal {
namespace {

// Bins of 0.5 % from 1e-12 to 1e12.
constexpr double kLow = 1e-12;
const double kLogStep = std::log(1.005);
constexpr int kBins = 11100;

}  // namespace

double Clipped(double r) {
  return r * EvaluateLoss(RobustLoss::kHuber, r).weight;
}

ResidualSpread::ResidualSpread() : histogram_(kBins, 0) {}

void ResidualSpread::Add(double r) {
  const double bin = std::log(std::max(std::abs(r), kLow) / kLow) / kLogStep;
  ++histogram_[bin < kBins ? static_cast<int>(bin) : kBins - 1];  // also NaN
  ++count_;
}

double ResidualSpread::Value() const {
  long seen = 0;
  for (int b = 0; b < kBins; ++b) {
    seen += histogram_[b];
    if (2 * seen >= count_ && count_ > 0) {
      return 1.4826 * kLow * std::exp((b + 0.5) * kLogStep);
    }
  }
  return 0;
}

ResidualStatistics::ResidualStatistics(int lag) : lag_(lag) {}

void ResidualStatistics::Add(double r) {
  spread_.Add(r);
  const double clipped = Clipped(r);
  if (std::abs(clipped) < 0.5 * std::abs(r)) ++outliers_;
  square_ += clipped * clipped;
  recent_.push_back(clipped);
  if (recent_.size() <= lag_) return;
  product_ += clipped * recent_.front();
  recent_.pop_front();
}

void ResidualStatistics::Break() { recent_.clear(); }

double ResidualStatistics::Autocorrelation() const {
  return square_ > 0 ? product_ / square_ : 0;
}

}  // namespace armcal
