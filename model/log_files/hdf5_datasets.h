#pragma once

#include <string>

namespace armcal {

// Throws InputError where reading an HDF5 file, which .mat files of v7.3 are,
// would do more than read it: follow links to other files, numbers stored in
// them or views of them; or, for each of the pieces that a damaged dataset
// claims to consist of, fill memory. Files of other formats pass.
void CheckHdf5Datasets(const std::string& path);

}  // namespace armcal
