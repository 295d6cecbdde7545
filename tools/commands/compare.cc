#include "tools/commands/compare.h"

#include <gflags/gflags.h>

#include "calib/compare.h"
#include "tools/command_report.h"
#include "tools/input_flags.h"
#include "tools/log_flags.h"

DEFINE_string(results, "",
              "`FILES` what to compare, also without --results=: results of "
              "calibrate, diagnose or verify, folders of them, or robot files "
              "A,B[,C..]");

namespace armcal {
namespace {

CompareOptions OptionsFromFlags(const CommandInput& input) {
  const FlagValues& flags = input.flags;
  CompareOptions options;
  options.read_robot = [&flags](const std::string& path) {
    return RobotOfFile(path, flags);
  };
  if (!flags.Text("log").empty()) {
    options.robot = RobotFromFlags(input);
    options.reading = LogOptionsFromFlags(flags, *options.robot);
    options.logs = LogInputFromFlags(input);
  }
  options.bandwidth_hz = BandwidthFromFlags(flags);
  options.progress = input.progress;
  return options;
}

CommandOutcome RunCompare(const CommandInput& input) {
  const std::string names = input.flags.Text("results");
  if (names.empty()) {
    throw UsageError("two results are needed: armcal compare A B");
  }
  const std::vector<std::string> results = FileNames("results", names);
  const CompareSummary summary = Compare(results, OptionsFromFlags(input));
  CommandOutcome outcome = OutcomeWithoutRobot(input, summary);
  std::vector<std::string> files = results;
  if (!input.flags.Text("log").empty()) {
    for (const std::string& log : LogsFromFlags(input)) files.push_back(log);
  }
  AddReportWithoutRobot(input, "compare", summary.robot, summary.json, files,
                        nullptr, &outcome.folders[0]);
  return outcome;
}

}  // namespace

Command CompareCommand() {
  return {"compare",
          "whether results of one robot agree within noise",
          {{"results", {"results"}},
           {"torque left on a log", {"robot", "log", "crop", "bandwidth"}},
           TorqueFlags(),
           ChainFlags()},
          {"armcal compare monday tuesday",
           "armcal compare arm.urdf after/calibration.json",
           "armcal compare monday tuesday --robot=arm.urdf --log=held_out.csv "
           "--out=compared"},
          &RunCompare,
          "results"};
}

}  // namespace armcal
