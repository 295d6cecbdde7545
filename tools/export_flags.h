#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calib/diagnose/robot_export.h"
#include "tools/flag_values.h"
#include "tools/output_folder.h"

namespace armcal {

// --export: the formats that the robot is written in. UsageError for any other.
std::vector<const RobotFormat*> ExportFromFlags(const FlagValues& flags);
// The same for a command that writes robot.urdf in any case.
std::vector<const RobotFormat*> ExportBesideUrdfFromFlags(
    const FlagValues& flags);

// Adds the files to the folder, and where there are any robot_files[] {format,
// file, losses[]} to `json`. Returns what is lost, a line each.
std::string AddFiles(const std::vector<RobotFile>& files, nlohmann::json* json,
                     OutputFolder* out);
// The same of a robot in these formats.
std::string AddExports(const RobotDescription& description,
                       const std::vector<const RobotFormat*>& formats,
                       nlohmann::json* json, OutputFolder* out);

}  // namespace armcal
