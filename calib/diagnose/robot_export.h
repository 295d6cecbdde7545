#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calib/diagnose/candidates/corrected_robot.h"
#include "model/robot_files/robot_format.h"
#include "model/text/document.h"

namespace armcal {

// A robot in a format, and what it does not hold, a sentence each.
struct RobotFile {
  const RobotFormat* format;
  std::string text;
  std::vector<std::string> losses;
};
// robot_files[] {format, file, losses[]}.
nlohmann::json RobotFilesJson(const std::vector<RobotFile>& files);

// A corrected robot as files for simulators.
struct RobotExport {
  // Fitted links and friction, and of the effects what URDF has fields for: the
  // links', viscous and Coulomb friction, lengths.
  std::string urdf;
  // What the URDF does not hold, a sentence each.
  std::vector<std::string> losses;
  std::vector<RobotFile> files;  // of the formats that were asked for
  nlohmann::json effects;        // all of it: EffectsJson
};

// `urdf`: the file of `file`, the robot without corrections, which is kept but
// for its numbers; `base` as for UpdateUrdf. Without a name: a URDF of the
// chain alone. Throws InputError where the file is not the robot's.
RobotExport ExportCorrectedRobot(
    const CorrectedRobot& corrected, const Robot& file, const Document& urdf,
    const std::string& base = "",
    const std::vector<const RobotFormat*>& formats = {});

}  // namespace armcal
