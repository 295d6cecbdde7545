#pragma once

#include <vector>

#include "calib/inspect/torque_scale.h"
#include "calib/logs/inspection_finding.h"
#include "calib/logs/wiring.h"
#include "model/robot/robot.h"

namespace armcal {

// Torques that are not what they are read as, told by their scale beside what
// the robot file's links need (TorqueScale): of all joints alike, or of some.
// `robot` has the gravity that the log fits.
//
// **All joints.** Inertias that are all s times as large need torques that are
// s times as large: no fit of inertias can tell them from a unit. Only what is
// plausible of a file can: masses are measured or computed from drawings, and
// are not off by a factor of 4 in all links at once. A unit is named where the
// torques, read in it, leave clearly less beside the file's inertias.
//
// **Some joints.** A payload or a spring multiplies single joints' torques,
// too; but a load on one joint is carried by the joints before it. So inertias
// are left free, and what is asked of one joint after the other is whether an
// arm explains torques that it was not fitted to clearly better once this
// joint's are divided by their scale.
std::vector<InspectionFinding> FindTorqueUnits(const Robot& robot,
                                               const WiringSamples& samples,
                                               const TorqueScales& scales);

}  // namespace armcal
