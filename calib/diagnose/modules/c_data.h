#pragma once

#include <string>

#include "calib/diagnose/candidates/corrected_robot.h"
#include "calib/diagnose/modules/module_test.h"

namespace armcal {

// effects_data.h: the numbers that effects.c (assets/) works with, a line for
// each law, of joints' own friction and of effects, and what it compares itself
// with.
std::string CData(const CorrectedRobot& robot, const ModuleTest& test);

}  // namespace armcal
