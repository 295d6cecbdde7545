#pragma once

#include <string>

namespace armcal {

// The first 24 bytes of a file, fewer where it has no more; they tell formats.
std::string FirstBytes(const std::string& path);

}  // namespace armcal
