#pragma once

#include <pybind11/pybind11.h>

namespace armcal {

// Adds run and Outcome (a command of the armcal binary, its flags given as
// texts), trace and read_log.
void AddCommands(pybind11::module_* module);

}  // namespace armcal
