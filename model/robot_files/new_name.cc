#include "model/robot_files/new_name.h"

namespace armcal {

std::string NewName(const Robot& robot, const std::string& wish) {
  const auto is_taken = [&](const std::string& name) {
    if (name == robot.tool_name) return true;
    for (const Link& link : robot.links) {
      if (link.name == name || link.joint.name == name) return true;
    }
    return false;
  };
  std::string name = wish;
  while (is_taken(name)) name += "_";
  return name;
}

}  // namespace armcal
