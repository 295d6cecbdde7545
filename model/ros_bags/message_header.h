#pragma once

#include <cstdint>
#include <string_view>

#include "model/ros_bags/cdr_reader.h"

namespace armcal {

// Whether a topic's type is `package`'s `name`, also without /msg as in ROS 1.
bool IsMessageType(std::string_view type, std::string_view package,
                   std::string_view name);

// Reads std_msgs/msg/Header, which begins every stamped message, and returns
// its stamp (ns). The frame's name is stepped over. Throws CdrError.
std::int64_t ReadStamp(CdrReader* cdr);

}  // namespace armcal
