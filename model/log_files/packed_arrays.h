#pragma once

#include <string>
#include <vector>

#include "model/log_files/log_array.h"

namespace armcal {

// Arrays as bytes from one process to another of the same program.
std::string PackArrays(const std::vector<LogArray>& arrays);
// Nothing where the bytes are not such.
std::vector<LogArray> UnpackArrays(const std::string& bytes);

}  // namespace armcal
