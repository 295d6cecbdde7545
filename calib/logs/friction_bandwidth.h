#pragma once

#include "calib/logs/encoder_noise.h"

namespace armcal {

// The cutoff, Hz, of the motion that friction changes sign with, for logs whose
// other motion is low-passed at `bandwidth_hz` > 0.
//
// A joint's dry friction turns over within a few mrad/s, faster than the joint
// itself: the sign of a low-passed velocity turns at another time than the
// velocity, and stays where the joint only quivers. So friction follows a
// velocity of the torque's band, kTorqueBand times the bandwidth, as far as the
// encoders' noise allows it. White noise of two-sided power spectral density S
// (rad^2 s) passes the low pass of gain 1 / (1 + (f / b)^8) (low_pass.h) and is
// differentiated, to a velocity of variance
//   2 S (2 pi)^2 int f^2 / (1 + (f / b)^8)^2 df
//     = 8 pi^2 S b^3 5 pi / (64 sin(3 pi / 8)),
// whose root stays below half of the sharpest transition that is looked for
// (CoulombTransition::kSharpestVelocity), so that noise counts for no width.
// The joint with the noisiest encoder decides; never below `bandwidth_hz`.
double FrictionBandwidth(const EncoderNoise& noise, double bandwidth_hz);

}  // namespace armcal
