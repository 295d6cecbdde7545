#include "tools/export_flags.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <utility>

#include "model/robot_files/robot_formats.h"
#include "tools/flag_choices.h"
#include "tools/input_flags.h"

DEFINE_string(export, "", "formats to write the robot in");

namespace armcal {
namespace {

std::vector<std::pair<std::string, const RobotFormat*>> Formats() {
  std::vector<std::pair<std::string, const RobotFormat*>> formats;
  for (const RobotFormat& format : RobotFormats()) {
    formats.push_back({format.name, &format});
  }
  return formats;
}

const FlagChoices<const RobotFormat*> kFormats("export", Formats(), true);

}  // namespace

std::vector<const RobotFormat*> ExportFromFlags(const FlagValues& flags) {
  std::vector<const RobotFormat*> formats;
  for (const std::string& name : SplitAtCommas(flags.Text("export"))) {
    const RobotFormat* format = kFormats.Parse(name);
    if (std::count(formats.begin(), formats.end(), format) == 0) {
      formats.push_back(format);
    }
  }
  return formats;
}

std::vector<const RobotFormat*> ExportBesideUrdfFromFlags(
    const FlagValues& flags) {
  std::vector<const RobotFormat*> formats;
  for (const RobotFormat* format : ExportFromFlags(flags)) {
    if (std::string(format->name) != "urdf") formats.push_back(format);
  }
  return formats;
}

std::string AddFiles(const std::vector<RobotFile>& files, nlohmann::json* json,
                     OutputFolder* out) {
  std::string lines;
  for (const RobotFile& file : files) {
    out->Add(file.format->file, file.text);
    for (const std::string& loss : file.losses) {
      lines += std::string(file.format->file) + "  " + loss + "\n";
    }
  }
  if (!files.empty()) (*json)["robot_files"] = RobotFilesJson(files);
  return lines;
}

std::string AddExports(const RobotDescription& description,
                       const std::vector<const RobotFormat*>& formats,
                       nlohmann::json* json, OutputFolder* out) {
  std::vector<RobotFile> files;
  for (const RobotFormat* format : formats) {
    files.push_back(
        {format, format->write(description), Losses(*format, description)});
  }
  return AddFiles(files, json, out);
}

}  // namespace armcal
