#pragma once

#include "calib/logs/encoder_noise.h"
#include "model/signals/trajectory.h"

namespace armcal {

// The motion that friction changes sign with, for logs whose other motion is
// low-passed at `bandwidth_hz` > 0.
//
// A joint's dry friction turns over within a few mrad/s, or a tenth of a mrad,
// faster than the joint itself: the sign of a low-passed velocity turns at
// another time than the velocity, and stays where the joint only quivers. So
// friction follows a motion of the torque's band, b = kTorqueBand times the
// bandwidth, as far as the encoders' noise allows it. White noise of two-sided
// power spectral density S (rad^2 s) that passes the low pass, of gain
// 1 / (1 + (f / b)^8) (low_pass.h), is a position and a velocity of variance
//   2 S int 1 / (1 + (f / b)^8)^2 df = 2 S b B(1/8, 15/8) / 8
//   2 S (2 pi)^2 int f^2 / (1 + (f / b)^8)^2 df
//     = 8 pi^2 S b^3 B(3/8, 13/8) / 8,
// B being Euler's beta function. Their roots stay below half of the sharpest
// transition that is looked for (CoulombTransition), so that noise counts for
// no width; S is that of slow joints, as that is where friction changes sign.
// The joint with the noisiest encoder decides; never below `bandwidth_hz`.
FrictionBand FrictionBandwidth(const EncoderNoise& noise, double bandwidth_hz);

}  // namespace armcal
