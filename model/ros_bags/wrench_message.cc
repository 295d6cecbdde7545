#include "model/ros_bags/wrench_message.h"

#include "model/ros_bags/cdr_reader.h"
#include "model/ros_bags/message_header.h"

namespace armcal {

bool IsWrenchStamped(std::string_view type) {
  return IsMessageType(type, "geometry_msgs", "WrenchStamped");
}

void ReadWrenchStamped(std::string_view message, StampedWrench* wrench) {
  CdrReader cdr(message);
  wrench->stamp = ReadStamp(&cdr);
  wrench->values.resize(6);
  for (double& value : wrench->values) value = cdr.Double();
  cdr.End();
}

}  // namespace armcal
