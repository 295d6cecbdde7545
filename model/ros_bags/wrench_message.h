#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace armcal {

// What a force-torque sensor publishes: geometry_msgs/msg/WrenchStamped.
struct StampedWrench {
  std::int64_t stamp = 0;      // of the header, ns
  std::vector<double> values;  // force (N), then torque (N m): six numbers
};

bool IsWrenchStamped(std::string_view type);
// Throws CdrError.
void ReadWrenchStamped(std::string_view message, StampedWrench* wrench);

}  // namespace armcal
