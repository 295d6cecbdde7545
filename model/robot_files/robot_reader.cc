#include "model/robot_files/robot_reader.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "model/robot_files/mjcf/mjcf_reader.h"
#include "model/robot_files/sdf_reader.h"
#include "model/robot_files/urdf_reader.h"
#include "model/robot_files/yaml_reader.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "model/text/xml_element.h"

namespace armcal {
namespace {

// Finite numbers of a file can still have products that are not.
void RefuseOverflow(const std::string& path, const Robot& robot) {
  for (const Link& link : robot.links) {
    if (link.inertial.ToVector().allFinite() &&
        link.X_PF.matrix().allFinite() && link.X_ML.matrix().allFinite()) {
      continue;
    }
    throw InputError(path, "", "",
                     "the numbers of link " + Quoted(link.name) +
                         " are too large to calculate with");
  }
  if (robot.X_LT.matrix().allFinite()) return;
  throw InputError(path, "", "",
                   "the numbers of the tool are too large to calculate with");
}

RobotFileKind KindOfXml(const Document& document) {
  const XmlFile file(document);
  const std::string tag = file.root().tag();
  if (tag == "robot") return RobotFileKind::kUrdf;
  if (tag == "mujoco") return RobotFileKind::kMjcf;
  if (tag == "sdf") return RobotFileKind::kSdf;
  file.root().Refuse("", tag,
                     "expected the root element <robot> (URDF), <mujoco> "
                     "(MJCF) or <sdf>");
}

}  // namespace

RobotFileKind KindOfRobotFile(const Document& file) {
  const std::string& path = file.name();
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (ending == ".urdf" || ending == ".xml" || ending == ".mjcf" ||
      ending == ".sdf") {
    return KindOfXml(file);
  }
  if (ending == ".yaml" || ending == ".yml") return RobotFileKind::kYaml;
  if (ending == ".xacro") {
    throw InputError(path, "", "", kRunXacro);
  }
  throw InputError(path, "", ending,
                   "expected a robot file that ends in .urdf, .xml, .mjcf or "
                   ".sdf (URDF, MJCF or SDF) or .yaml or .yml (DH table or "
                   "poses)");
}

Robot ReadRobot(const Document& file, const RobotReaderOptions& options) {
  const RobotFileKind kind = KindOfRobotFile(file);
  const Robot robot = kind == RobotFileKind::kUrdf   ? ReadUrdf(file, options)
                      : kind == RobotFileKind::kMjcf ? ReadMjcf(file, options)
                      : kind == RobotFileKind::kSdf  ? ReadSdf(file, options)
                                                     : ReadYaml(file, options);
  RefuseOverflow(file.name(), robot);
  return robot;
}

}  // namespace armcal
