#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "model/ros_bags/bag_file.h"

namespace armcal {

// Whether a file that begins so is one: SQLite (.db3) or MCAP.
bool IsBagFile(std::string_view first_bytes);
std::unique_ptr<BagFile> OpenBagFile(const std::string& path,
                                     const BagFile::Wanted& wanted);

}  // namespace armcal
