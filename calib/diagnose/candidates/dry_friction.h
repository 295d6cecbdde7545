#pragma once

#include <vector>

#include "calib/logs/joint_term_laws.h"
#include "model/robot/joint_drive.h"

namespace armcal {

// A joint's Coulomb friction, and what a Stribeck law in `drive` adds to it, as
// saturating parts (drive->dry) and bristles (drive->bristles), which is what
// simulators have.
//
// The parts of a fit may be of either sign. Their sum is one curve f(v) over
// the velocity v > 0. Where it exceeds its end value it is a Stribeck curve,
// and the nearest bump s exp(-(v/w)^2) becomes bristles; what is left is
// replaced by the smallest concave curve above it through a few knots, and a
// concave curve whose slope is a_k before the k-th knot w_k and a_(k+1) behind
// it is the sum of parts that saturate at w_k with w_k (a_k - a_(k+1)). Parts
// that yield with displacement are bristles already.
// `width` is that within which the Stribeck law changes sign, rad/s or m/s.
// Returns what is not bristles', 0 where it does not brake: then there are no
// parts.
double SetDryFriction(const std::vector<CoulombPart>& coulomb, double width,
                      JointDrive* drive);

}  // namespace armcal
