#pragma once

#include <pybind11/pybind11.h>

#include "tools/python/loaded_robot.h"

namespace armcal {

// Adds read_robot, and to Robot from_text and what it was read from: path,
// source, text, base, tip.
void AddRobotReading(pybind11::module_* module,
                     pybind11::class_<LoadedRobot>* robot);

}  // namespace armcal
