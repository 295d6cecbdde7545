#pragma once

#include <string>
#include <vector>

namespace armcal {

// The files of a bag in the order of recording: `path` itself where it is a
// file; of a folder those that its metadata.yaml names, or, where a recorder
// that was stopped has left none, the bags in it. Throws InputError.
std::vector<std::string> BagFiles(const std::string& path);

}  // namespace armcal
