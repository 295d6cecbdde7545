#include "calib/logs/clock_text.h"

#include "model/text/format.h"

namespace armcal {

std::string ClockSentence(const SampleClock& clock) {
  return Format(
      "the stamps are not when the samples were taken: rows are %.5g ms apart "
      "in the mean, not %.5g ms",
      1e3 * clock.period, 1e3 * clock.period / clock.rate);
}

std::string ClockEvidence(const SampleClock& clock) {
  std::string text = Format(
      "positions and velocities of two groups of joints tell %+.2f %% (+- %.2f "
      "%%) and a rate that wanders by %.1f %% (correlation %.2f)",
      100 * (clock.rate - 1),
      100 * clock.rate * clock.period_stddev / clock.period, 100 * clock.wander,
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
