#pragma once

#include <string>

#include "model/log_files/log_array.h"

namespace armcal {

// An array of NumPy's .npy format, versions 1 to 3: little-endian floats or
// integers of one or two dimensions, or texts of one; other arrays hold neither
// numbers nor texts. `name` and `file` are for messages. Throws InputError
// where the header is damaged or the bytes are too few.
LogArray ReadNpy(const std::string& file, const std::string& name,
                 std::string bytes);

}  // namespace armcal
