#pragma once

#include <vector>

#include "model/log_files/time_base.h"

namespace armcal {

// The cutoff, Hz, below which logs with these time bases are looked at where
// nobody asks for another.
//
// For a calibration: 10 times the fastest motion's frequency, between 8 and 20
// Hz (friction changes sign, and accelerations begin, faster than the bulk of
// the motion), and at most a fifth of every sample rate.
double DefaultBandwidth(const std::vector<TimeBase>& time_bases);

// For a diagnosis: effects bend torques faster than motions go, so at least
// 10 Hz, and at most an eighth of every sample rate.
double DiagnosisBandwidth(const std::vector<TimeBase>& time_bases);

}  // namespace armcal
