#include "tools/export_flags.h"

#include <gflags/gflags.h>

#include <utility>

#include "model/robot_files/robot_formats.h"
#include "tools/flag_choices.h"
#include "tools/input_flags.h"

DEFINE_string(export, "", "formats to write the robot in");

namespace armcal {
namespace {

std::vector<std::pair<std::string, std::string>> Formats() {
  std::vector<std::pair<std::string, std::string>> formats;
  for (const RobotFormat& format : RobotFormats()) {
    formats.push_back({format.name, format.name});
  }
  return formats;
}

const FlagChoices<std::string> kFormats("export", Formats(), true);

}  // namespace

std::vector<std::string> ExportFromFlags(const FlagValues& flags) {
  std::vector<std::string> formats;
  for (const std::string& name : SplitAtCommas(flags.Text("export"))) {
    formats.push_back(kFormats.Parse(name));
  }
  return formats;
}

}  // namespace armcal
