#include "model/robot_reader.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "model/dh_reader.h"
#include "model/input_error.h"
#include "model/input_text.h"
#include "model/urdf_reader.h"

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

Robot ReadByEnding(const std::string& path, const RobotReaderOptions& options) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (ending == ".urdf" || ending == ".xml") return ReadUrdf(path, options);
  if (ending == ".yaml" || ending == ".yml") return ReadDhTable(path, options);
  if (ending == ".xacro") {
    throw InputError(path, "", "", "expected a plain URDF: run xacro first");
  }
  throw InputError(path, "", ending,
                   "expected a robot file that ends in .urdf or .xml (URDF) or "
                   ".yaml or .yml (DH table)");
}

}  // namespace

Robot ReadRobot(const std::string& path, const RobotReaderOptions& options) {
  const Robot robot = ReadByEnding(path, options);
  RefuseOverflow(path, robot);
  return robot;
}

}  // namespace armcal
