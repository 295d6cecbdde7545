#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace armcal {

// What a message says of joints. Each of the arrays has a number per name or
// none at all.
struct JointState {
  std::int64_t stamp = 0;  // of the header, ns
  std::vector<std::string_view> names;
  std::string_view name_bytes;  // equal for equal names
  std::vector<double> position, velocity, effort;
  std::vector<double> reference;  // position asked for
};

// The types whose messages are read, also without /msg as in ROS 1.
bool IsJointState(std::string_view type);
bool IsFloat64MultiArray(std::string_view type);
// Of ros2_control: control_msgs/msg/DynamicJointState, whose joints have values
// by names of interfaces; JointTrajectoryControllerState, which has what the
// controller asks for too (so do those of before 2022, which call it desired).
bool IsDynamicJointState(std::string_view type);
bool IsControllerState(std::string_view type);

// *state keeps views into `message`. A value that a joint of a
// DynamicJointState lacks is NaN. Throws CdrError.
void ReadJointState(std::string_view message, JointState* state);
void ReadDynamicJointState(std::string_view message, JointState* state);
void ReadControllerState(std::string_view message, JointState* state);
// The numbers of std_msgs/msg/Float64MultiArray from its offset on.
void ReadFloat64MultiArray(std::string_view message,
                           std::vector<double>* values);

}  // namespace armcal
