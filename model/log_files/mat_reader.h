#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/log_files/log_array.h"

namespace armcal {

// Whether a file that begins so is MATLAB's: v5 to v7.3 say it in their text,
// v4 has a header of numbers that no text begins with.
bool IsMatFile(std::string_view first_bytes);

// The arrays of a .mat file of MATLAB, v4, v5 (compressed or not), v7.3, which
// array_source.h makes a table of: its variables, or where none of them is a
// time, the fields of the one structure that has it. A matrix of one row is a
// column, cells of texts are texts. Throws InputError.
std::vector<LogArray> ReadMat(const std::string& path);

}  // namespace armcal
