#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace armcal {

// sensor_msgs/msg/JointState. Each of the three arrays has a number per name or
// none at all.
struct JointState {
  std::int64_t stamp = 0;  // of the header, ns
  std::vector<std::string_view> names;
  std::string_view name_bytes;  // equal for equal names
  std::vector<double> position, velocity, effort;
};

// The types whose messages are read, also without /msg as in ROS 1.
bool IsJointState(std::string_view type);
bool IsFloat64MultiArray(std::string_view type);

// *state keeps views into `message`. Throws CdrError.
void ReadJointState(std::string_view message, JointState* state);
// The numbers of std_msgs/msg/Float64MultiArray from its offset on.
void ReadFloat64MultiArray(std::string_view message,
                           std::vector<double>* values);

}  // namespace armcal
