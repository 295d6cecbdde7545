#pragma once

#include <string>

namespace armcal {

// Throws InputError where a .mat file of v4 or v5 is cut off, where what it
// packs does not unpack to its checksum, or where a matrix has other numbers
// than its dimensions say: libmatio takes what is left as if it were all. Files
// of v7.3 pass, HDF5 looks after them.
void CheckMatElements(const std::string& path);

}  // namespace armcal
