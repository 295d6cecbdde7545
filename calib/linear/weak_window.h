#pragma once

#include "calib/logs/encoder_noise.h"
#include "calib/logs/log_set.h"

namespace armcal {

// Length of the weak form's test functions where nobody asks for one, s: as
// short as the bandwidth (which they pass at half power, so that they see what
// the differential model sees of friction that changes sign), the sample rate
// (16 samples) and the encoders' noise (NoiseWindow) let it be.
double DefaultWindow(double bandwidth_hz, const LogSet& logs);

// The length, s, at which white noise of positions, low-passed at
// `bandwidth_hz` > 0 as logs are, makes 2e-4 of the mean square acceleration
// that a row sees, of the joint that needs the longest; 0 where the low pass is
// enough, at most 0.3, as where a joint moves that no motor drives. Joints that
// do not move do not count.
double NoiseWindow(const EncoderNoise& noise, double bandwidth_hz);

}  // namespace armcal
