#include "calib/robot_outputs.h"

#include <algorithm>

#include "model/robot_files/robot_formats.h"
#include "model/robot_files/urdf_update.h"
#include "model/robot_files/urdf_writer.h"
#include "model/text/format.h"
#include "model/text/input_text.h"
#include "model/text/option_error.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

const RobotFormat* FormatNamed(const std::string& name) {
  std::vector<std::string> names;
  for (const RobotFormat& format : RobotFormats()) {
    if (format.name == name) return &format;
    names.push_back(format.name);
  }
  throw OptionError(OptionName("export") + ": found '" + name +
                    "', expected one of " + JoinNames(names));
}

}  // namespace

std::vector<const RobotFormat*> FormatsNamed(
    const std::vector<std::string>& names) {
  std::vector<const RobotFormat*> formats;
  for (const std::string& name : names) {
    const RobotFormat* const format = FormatNamed(name);
    if (std::count(formats.begin(), formats.end(), format) == 0) {
      formats.push_back(format);
    }
  }
  return formats;
}

std::vector<const RobotFormat*> FormatsBesideUrdf(
    const std::vector<std::string>& names) {
  std::vector<const RobotFormat*> formats = FormatsNamed(names);
  formats.erase(std::remove_if(formats.begin(), formats.end(),
                               [](const RobotFormat* format) {
                                 return std::string(format->name) == "urdf";
                               }),
                formats.end());
  return formats;
}

std::string AddRobotFiles(const std::vector<RobotFile>& files,
                          nlohmann::json* json,
                          std::vector<ResultFile>* results) {
  std::string lines;
  for (const RobotFile& file : files) {
    results->push_back({file.format->file, file.text});
    for (const std::string& loss : file.losses) {
      lines += std::string(file.format->file) + "  " + loss + "\n";
    }
  }
  if (!files.empty()) (*json)["robot_files"] = RobotFilesJson(files);
  return lines;
}

std::string AddExports(const RobotDescription& description,
                       const std::vector<const RobotFormat*>& formats,
                       nlohmann::json* json, std::vector<ResultFile>* results) {
  std::vector<RobotFile> files;
  for (const RobotFormat* format : formats) {
    files.push_back(
        {format, format->write(description), Losses(*format, description)});
  }
  return AddRobotFiles(files, json, results);
}

// What stands beside the robot of a file, such as actuators in Python, has the
// robot's name and its own ending.
std::string SampleFile(const std::string& file, int r, int count) {
  const int digits = static_cast<int>(std::to_string(count).size());
  const std::string kind = file.rfind("effects", 0) == 0 ? "effects" : "robot";
  const bool is_of_kind = file.rfind(kind, 0) == 0;
  return Format("samples/%s_%0*d", kind.c_str(), digits, r + 1) +
         file.substr(is_of_kind ? kind.size() : file.find('.'));
}

std::string AddSamples(int count, nlohmann::json* json) {
  (*json)["samples"] = {{"count", count}, {"file", "samples.csv"}};
  return Format(
      "samples  %d robots that the data and the file allow, each of them "
      "possible: samples.csv, samples/\n",
      count);
}

RobotUrdfFile RobotUrdf(const RobotSource& source, const Robot& robot,
                        bool geometry) {
  if (!source.urdf) return {MakeUrdf(robot), UrdfLosses(robot)};
  RobotUrdfFile file;
  file.losses = Losses(UpdatedUrdfFormat(), {robot, {}});
  file.text =
      UpdateUrdf(*source.urdf, robot, geometry, source.base, &file.losses);
  return file;
}

std::string AddRobotUrdf(const RobotSource& source, const Robot& robot,
                         bool geometry, std::vector<ResultFile>* results) {
  const RobotUrdfFile urdf = RobotUrdf(source, robot, geometry);
  results->push_back({"robot.urdf", urdf.text});
  std::string lines;
  for (const std::string& loss : urdf.losses) {
    lines += "robot.urdf  " + loss + "\n";
  }
  return lines;
}

}  // namespace armcal
