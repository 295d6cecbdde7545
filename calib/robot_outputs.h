#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calib/diagnose/robot_export.h"
#include "calib/robot_source.h"
#include "calib/summary.h"

namespace armcal {

// The formats of these names, each once. OptionError for any other.
std::vector<const RobotFormat*> FormatsNamed(
    const std::vector<std::string>& names);
// The same for a result that has robot.urdf in any case.
std::vector<const RobotFormat*> FormatsBesideUrdf(
    const std::vector<std::string>& names);

// Adds the files to a result's, and where there are any robot_files[] {format,
// file, losses[]} to `json`. Returns what is lost, a line each.
std::string AddRobotFiles(const std::vector<RobotFile>& files,
                          nlohmann::json* json,
                          std::vector<ResultFile>* results);
// The same of a robot in these formats.
std::string AddExports(const RobotDescription& description,
                       const std::vector<const RobotFormat*>& formats,
                       nlohmann::json* json, std::vector<ResultFile>* results);

// The name of the r-th of `count` drawn robots' files, from 0, for one robot's
// file: samples/robot_01.urdf, samples/robot_01_plain.xml,
// samples/effects_01.json.
std::string SampleFile(const std::string& file, int r, int count);
// Says in `json` that so many robots were drawn, of which samples.csv has the
// parameters. Returns the line of a report.
std::string AddSamples(int count, nlohmann::json* json);

// robot.urdf: a URDF that the robot was read from with its numbers changed, its
// origins too with `geometry`; else the chain alone. And what it cannot say of
// the robot.
struct RobotUrdfFile {
  std::string text;
  std::vector<std::string> losses;
};
RobotUrdfFile RobotUrdf(const RobotSource& source, const Robot& robot,
                        bool geometry);
// Adds it to a result's files. Returns what is lost, a line each.
std::string AddRobotUrdf(const RobotSource& source, const Robot& robot,
                         bool geometry, std::vector<ResultFile>* results);

}  // namespace armcal
