#pragma once

#include <string>
#include <vector>

#include "model/log_files/log_array.h"

namespace armcal {

// The arrays of an archive of NumPy's (numpy.savez, savez_compressed), which
// array_source.h makes a table of. Pickled objects are never loaded. Throws
// InputError.
std::vector<LogArray> ReadNpz(const std::string& path);

}  // namespace armcal
