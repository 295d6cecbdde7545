#pragma once

#include <string>

#include "calib/logs/sample_clock.h"

namespace armcal {

// "the stamps are not when the samples were taken: ..", of a clock that is
// wrong.
std::string ClockSentence(const SampleClock& clock);

// By what figures that is told.
std::string ClockEvidence(const SampleClock& clock);

// The same of stamps that jitter about a clock that is right.
std::string JitterSentence(const SampleClock& clock);
std::string JitterEvidence(const SampleClock& clock);

}  // namespace armcal
