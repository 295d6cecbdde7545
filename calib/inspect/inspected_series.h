#pragma once

#include "calib/logs/uniform_series.h"
#include "model/log_files/log.h"

namespace armcal {

// The log, its time in s, as an inspection asks its torques: below 8 Hz, or
// below a fifth of a slower log's rate, and away from gaps of a quarter of that
// frequency's period or of three steps.
UniformSeries InspectedSeries(const Log& log, double mean_step);

}  // namespace armcal
