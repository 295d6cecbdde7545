#include "model/robot_files/robot_formats.h"

#include "model/robot_files/isaac_writer.h"
#include "model/robot_files/mjcf_writer.h"
#include "model/robot_files/sdf_writer.h"
#include "model/robot_files/urdf_writer.h"
#include "model/robot_files/yaml_writer.h"

namespace armcal {

const std::vector<RobotFormat>& RobotFormats() {
  static const std::vector<RobotFormat> formats = {
      UrdfFormat(), MjcfFormat(), PlainMjcfFormat(),
      SdfFormat(),  YamlFormat(), IsaacFormat()};
  return formats;
}

}  // namespace armcal
