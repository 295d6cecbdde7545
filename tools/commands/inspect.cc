#include "tools/commands/inspect.h"

#include <gflags/gflags.h>

#include "calib/inspect.h"
#include "tools/command_report.h"
#include "tools/export_flags.h"
#include "tools/input_flags.h"
#include "tools/log_flags.h"

DEFINE_bool(fix, false,
            "write the logs as they are understood: order, signs and units");

namespace armcal {
namespace {

InspectOptions InspectOptionsFromFlags(const CommandInput& input) {
  const FlagValues& flags = input.flags;
  const bool writes = !OutFromFlags(flags).empty() || input.report;
  InspectOptions options;
  options.mend = flags.Switch("fix");
  if (options.mend && !writes) {
    throw UsageError("--fix needs --out=FOLDER to write to");
  }
  options.exports = ExportFormatsFromFlags(flags);
  if (!options.exports.empty() && !writes) {
    throw UsageError("--export needs --out=FOLDER to write to");
  }
  options.controller = flags.Text("controller");
  if (!options.controller.empty() && options.exports.empty()) {
    throw UsageError("--controller is for --export=mjcf, which writes drives");
  }
  options.progress = input.progress;
  return options;
}

CommandOutcome RunInspect(const CommandInput& input) {
  InspectOptions options = InspectOptionsFromFlags(input);
  const Robot robot = RobotFromFlags(input);
  options.reading = LogOptionsFromFlags(input.flags, robot);
  std::vector<LogSource> logs;
  if (!input.flags.Text("log").empty()) {
    logs = LogInputFromFlags(input).logs;
  }
  CommandOutcome outcome =
      OutcomeOf(input, robot, Inspect(robot, logs, options),
                // With logs the report is theirs.
                logs.empty() ? robot.notes : std::vector<std::string>());
  outcome.output.verdict = "";
  AddProvenance(input, "inspect", NamesOf(logs), &outcome.folders[0]);
  return outcome;
}

}  // namespace

Command InspectCommand() {
  return {"inspect",
          "what a robot file or a log holds, and what is wrong with it",
          {{"robot and logs", {"robot", "log", "fix", "export", "controller"}},
           TorqueFlags(),
           ChainFlags()},
          {"armcal inspect --robot=arm.urdf --log=log.csv",
           "armcal inspect --robot=arm.urdf --log=log.csv --fix --out=mended",
           "armcal inspect --robot=arm.urdf --export=mjcf,sdf --out=other"},
          &RunInspect};
}

}  // namespace armcal
