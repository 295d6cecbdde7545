#include "tools/export_flags.h"

#include <gflags/gflags.h>

#include <cmath>
#include <utility>

#include "model/robot_files/robot_formats.h"
#include "model/text/input_text.h"
#include "tools/flag_choices.h"
#include "tools/input_flags.h"
#include "tools/usage_error.h"

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
const std::string kSamples = "samples:";

int NumberOfSamples(const std::string& word) {
  constexpr int kMost = 10000;  // files in a folder
  const auto number = ParseNumber(word.substr(kSamples.size()));
  if (number && *number >= 1 && *number <= kMost &&
      *number == std::floor(*number)) {
    return static_cast<int>(*number);
  }
  throw UsageError("--export: found '" + word + "', expected " + kSamples +
                   "N with N robots to draw, 1 to " + std::to_string(kMost));
}

}  // namespace

ExportChoice ExportFromFlags(const FlagValues& flags) {
  ExportChoice choice;
  for (const std::string& word : SplitAtCommas(flags.Text("export"))) {
    if (word.rfind(kSamples, 0) == 0) {
      choice.samples = NumberOfSamples(word);
    } else {
      choice.formats.push_back(kFormats.Parse(word));
    }
  }
  return choice;
}

std::vector<std::string> ExportFormatsFromFlags(const FlagValues& flags) {
  const ExportChoice choice = ExportFromFlags(flags);
  if (choice.samples > 0) {
    throw UsageError(
        "--export: found 'samples', expected formats alone; samples are drawn "
        "from what armcal calibrate and armcal diagnose know");
  }
  return choice.formats;
}

}  // namespace armcal
