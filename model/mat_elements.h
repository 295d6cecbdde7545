#pragma once

#include <string>

namespace armcal {

// Throws InputError where a .mat file of v4 or v5 is cut off, or where what it
// packs does not unpack to its checksum: libmatio takes what is left as if it
// were all. Files of v7.3 pass, HDF5 looks after them.
void CheckMatElements(const std::string& path);

}  // namespace armcal
