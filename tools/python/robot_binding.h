#pragma once

#include <pybind11/pybind11.h>

namespace armcal {

// Adds Robot, read_robot and the names of inertial parameters.
void AddRobot(pybind11::module_* module);

}  // namespace armcal
