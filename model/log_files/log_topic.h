#pragma once

#include <optional>
#include <string>

#include "model/log_files/columns/log_signal.h"

namespace armcal {

// A topic of a ROS 2 bag that belongs to the log.
struct LogTopic {
  std::string name;
  // What its numbers are; nothing: what a JointState's fields say.
  std::optional<Signal> signal;
  // Of a force-torque sensor, not of joints.
  bool wrench = false;
};

}  // namespace armcal
