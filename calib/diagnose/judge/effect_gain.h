#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

namespace armcal {

// By how much one effect, given the others, lowers the mean square of data that
// it was not fitted to, in units of the noise's variance.
struct EffectGain {
  double value = 0;
  // The mean square D of what it changes there. Were the residual e with the
  // effect independent of the change d, `value` = E (e + d)^2 - E e^2 would be
  // D; where the effect is not there, and e that without it, -D.
  double expected = NAN;
  double ci95[2] = {NAN, NAN};  // of `value`

  // Whether the data show no less of a gap with it, and would have shown one:
  // what `expected` says lies above the interval. What changes little compared
  // to how much the rest of the gap swings is neither seen nor missed.
  bool IsNone() const { return value <= 0 && ci95[1] < expected; }
};

// From residuals without and with it, over their standard deviations: samples
// (in time) x joints, NaN where a joint stands still. The interval is a
// bootstrap of blocks over time of the paired difference, so that what both
// leave cancels.
EffectGain GainBetween(const Eigen::MatrixXd& without,
                       const Eigen::MatrixXd& with, std::uint64_t seed);

}  // namespace armcal
