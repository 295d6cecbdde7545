#pragma once

#include <optional>

namespace armcal {

// What a first-order low pass keeps of its state over a period at `rate_hz`.
double LowPassDecay(double cutoff_hz, double rate_hz);

// A drive's first-order lag over a period, s: what is left of what the torque
// is behind its command at the begin, at the end and in the mean; with
// derivatives.
struct LagShares {
  LagShares(double lag, double period);
  double end = 0, mean = 0;
  double end_by_lag = 0, mean_by_lag = 0;
};

// The torque behind such a lag, its command constant within periods; at the
// first command it has no lag to make up.
class LaggedTorque {
 public:
  LaggedTorque(double lag, double period) : shares_(lag, period) {}

  // Its mean over the next period.
  double Mean(double commanded);
  // How far it was behind the command when that period began.
  double behind() const { return behind_; }

 private:
  LagShares shares_;
  std::optional<double> torque_;
  double behind_ = 0;
};

}  // namespace armcal
