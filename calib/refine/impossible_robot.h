#pragma once

#include <string>

#include "calib/linear/calibration.h"
#include "calib/refine/arm_trust.h"
#include "calib/refine/nonlinear_calibration.h"

namespace armcal {

// A sentence where the logs are those of no robot: the linear model explains
// them, and nearly all that a robot that can exist leaves of them is explained
// by what none has, masses, inertias or friction that are negative. Empty
// where that is not so, or not known: the robot did not converge, or the file
// is trusted more than by default (`trust`), and may be what holds it off.
std::string WhatNoRobotExplains(const LinearCalibration& linear,
                                const NonlinearCalibration& refined,
                                const ArmTrust& trust);

}  // namespace armcal
