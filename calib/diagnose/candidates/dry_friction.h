#pragma once

#include <vector>

#include "calib/logs/joint_term_laws.h"
#include "model/robot/joint_drive.h"

namespace armcal {

// A joint's Coulomb friction, and what a Stribeck law in `drive` adds to it, as
// saturating parts (drive->dry), which is what simulators have.
//
// The parts of a fit may be of either sign. With the Stribeck law their sum is
// one curve f(v) over the velocity v > 0, which saturating parts follow within
// 2 % of its largest value (FitKnots). Where f exceeds its end value it falls
// with velocity, and the parts where it bends upwards are of negative force;
// else it is taken for one that only rises, ever less steeply, and no part is.
// Parts that yield with displacement become bristles.
// `width` is that within which the Stribeck law changes sign, rad/s or m/s.
// Returns f's end value, 0 where that does not brake: then there are no parts.
double SetDryFriction(const std::vector<CoulombPart>& coulomb, double width,
                      JointDrive* drive);

}  // namespace armcal
