#include "calib/logs/clock_text.h"

#include <cmath>

#include "model/text/format.h"

namespace armcal {

namespace {

// Of the rate.
double StddevOfRate(const SampleClock& clock) {
  return clock.rate * clock.period_stddev / clock.period;
}

}  // namespace

// A clock whose rate is right in the mean, as far as that is known, may be
// wrong all the same: by how much its rate wanders.
std::string ClockSentence(const SampleClock& clock) {
  const std::string wrong = "the stamps are not when the samples were taken: ";
  const double off = std::abs(clock.rate - 1);
  if (!clock.wrong_rate && off <= 2 * StddevOfRate(clock)) {
    return wrong + Format(
                       "their rate is right in the mean, and wanders by "
                       "%.1f %%",
                       100 * clock.wander);
  }
  return wrong + Format("rows are %.5g ms apart in the mean, not %.5g ms",
                        1e3 * clock.period, 1e3 * clock.period / clock.rate);
}

std::string ClockEvidence(const SampleClock& clock) {
  std::string text = Format(
      "positions and velocities of two groups of joints tell %+.2f %% (+- %.2f "
      "%%) and a rate that wanders by %.1f %% (correlation %.2f)",
      100 * (clock.rate - 1), 100 * StddevOfRate(clock), 100 * clock.wander,
      clock.correlation);
  if (clock.repeated > 0 || clock.skipped > 0) {
    text += Format("; %ld rows repeat a sample, %ld steps skip some",
                   clock.repeated, clock.skipped);
  }
  return text;
}

std::string JitterSentence(const SampleClock& clock) {
  return Format("the stamps jitter: steps are %.2g ms off in the rms",
                1e3 * clock.jitter);
}

std::string JitterEvidence(const SampleClock& clock) {
  return Format(
      "positions and velocities of two groups of joints tell so of each step "
      "alike (correlation %.2f)",
      clock.step_correlation);
}

}  // namespace armcal
