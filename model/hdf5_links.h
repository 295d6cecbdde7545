#pragma once

#include <string>

namespace armcal {

// Throws InputError where an HDF5 file, which .mat files of v7.3 are, leads to
// other files, which HDF5 would read as if they were part of it: links to
// them, numbers stored in them, views of them. Other files pass, as do damaged
// ones.
void CheckHdf5Links(const std::string& path);

}  // namespace armcal
