#pragma once

#include "calib/logs/encoder_noise.h"
#include "calib/logs/log_set.h"

namespace armcal {

// Length of the weak form's test functions where nobody asks for one, s: as
// short as the bandwidth (1.5 periods of it, so that a reversal of Coulomb
// friction that the bandwidth passes is seen) and the encoders' noise
// (NoiseWindow) let it be.
double DefaultWindow(double bandwidth_hz, const LogSet& logs);

// The length, s, at which white noise of positions makes 1e-4 of the mean
// square acceleration that a row sees, of the joint that needs the longest; at
// most 0.3. Joints that do not move do not count.
double NoiseWindow(const EncoderNoise& noise);

}  // namespace armcal
