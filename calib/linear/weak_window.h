#pragma once

#include "calib/logs/encoder_noise.h"
#include "calib/logs/log_set.h"

namespace armcal {

// Length of the weak form's test functions where nobody asks for one, s: as
// short as the bandwidth (1.5 periods of it, so that a reversal of Coulomb
// friction that the bandwidth passes is seen) and the encoders' noise
// (NoiseWindow) let it be.
double DefaultWindow(double bandwidth_hz, const LogSet& logs);

// The longest that noise asks for, s: accelerations of encoders with 1e-4 rad
// at 500 Hz then bias a SCARA's inertia by less than .02 % (its
// calibration_long_test.cc). Longer ones would not see friction change sign.
constexpr double kLongestNoiseWindow = 0.3;

// The length, s, at which white noise of positions makes 1e-4 of the mean
// square acceleration that a row sees, of the joint that needs the longest; at
// most kLongestNoiseWindow. Joints that do not move do not count.
double NoiseWindow(const EncoderNoise& noise);

}  // namespace armcal
