#pragma once

namespace armcal {

// A torque counts as at least so much of the largest of all states, so that an
// arm whose gravity loads no joint is not judged by its rounding.
inline constexpr double kSmallTorque = 1e-3;

// The largest of relative differences, NaN once one is.
class LargestRatio {
 public:
  void Add(double difference, double scale) {
    if (largest_ != largest_) return;
    const double ratio = difference == 0 ? 0 : difference / scale;
    if (!(ratio <= largest_)) largest_ = ratio;
  }
  double value() const { return largest_; }

 private:
  double largest_ = 0;
};

}  // namespace armcal
