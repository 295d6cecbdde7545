#pragma once

#include <pybind11/pybind11.h>

namespace armcal {

// Adds options and option_definitions: what is known of a command's flags.
void AddOptions(pybind11::module_* module);

}  // namespace armcal
