#include "model/dynamics/drive_filters.h"

#include <cmath>

namespace armcal {

double LowPassDecay(double cutoff_hz, double rate_hz) {
  return std::exp(-2 * M_PI * cutoff_hz / rate_hz);
}

LagShares::LagShares(double lag, double period) {
  if (lag <= 0) return;
  const double ratio = period / lag;
  end = std::exp(-ratio);
  mean = (1 - end) / ratio;
  end_by_lag = end * ratio / lag;
  mean_by_lag = mean / lag - end_by_lag / ratio;
}

double LaggedTorque::Mean(double commanded) {
  behind_ = torque_.value_or(commanded) - commanded;
  torque_ = commanded + shares_.end * behind_;
  return commanded + shares_.mean * behind_;
}

}  // namespace armcal
