#include "tools/commands/inspect.h"

#include <gflags/gflags.h>

#include "calib/inspect.h"
#include "tools/command_report.h"
#include "tools/export_flags.h"
#include "tools/input_flags.h"
#include "tools/log_flags.h"
#include "tools/report/report_data.h"

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
    throw UsageError(
        "--controller is for --export=mjcf, which writes drives; to inspect a "
        "log of commands leave it out (diagnose, calibrate and verify follow "
        "commands with it)");
  }
  options.progress = input.progress;
  return options;
}

// What the page draws of a log: {log, logs, position, velocity, torque}, each
// as PositionsJson has it, null where it is not logged.
nlohmann::json SignalsOfLog(const Robot& robot, const InspectedLog& log) {
  const auto json = [&](const std::optional<SeriesEnvelope>& drawn,
                        const std::vector<std::string>& labels) {
    if (!drawn) return nlohmann::json();
    return PositionsJson(robot, labels, {{log.name, *drawn}})[0];
  };
  std::vector<std::string> labels;
  if (log.drawing.commanded) labels.emplace_back("command");
  return {{"log", log.name},
          {"position", json(log.drawing.position, labels)},
          {"velocity", json(log.drawing.velocity, {})},
          {"torque", json(log.drawing.torque, {})}};
}

void AddInspectionReport(const CommandInput& input, const Robot& robot,
                         const InspectSummary& summary, OutputFolder* out) {
  std::vector<std::string> files;
  for (const InspectedLog& log : summary.logs) files.push_back(log.name);
  AddReport(
      input, "inspect", robot, summary.json, files,
      [&](ReportContent* content) {
        // The posture whose axes and centres of mass the tables have.
        content->skeleton =
            SkeletonJson(robot, Eigen::VectorXd::Zero(robot.num_joints()));
        nlohmann::json signals = nlohmann::json::array();
        for (const InspectedLog& log : summary.logs) {
          if (!log.drawing.position) continue;
          signals.push_back(SignalsOfLog(robot, log));
          signals.back()["logs"] = summary.logs.size();
        }
        content->extra["signals"] = signals;
      },
      out);
}

CommandOutcome RunInspect(const CommandInput& input) {
  InspectOptions options = InspectOptionsFromFlags(input);
  const Robot robot = RobotFromFlags(input);
  options.reading = LogOptionsFromFlags(input.flags, robot);
  std::vector<LogSource> logs;
  if (!input.flags.Text("log").empty()) {
    logs = LogInputFromFlags(input).logs;
  }
  options.draw = input.WantsReport();
  options.urdf = RobotSourceFromFlags(input).urdf;
  const InspectSummary summary = Inspect(robot, logs, options);
  CommandOutcome outcome =
      OutcomeOf(input, robot, summary,
                // With logs the report is theirs.
                logs.empty() ? robot.notes : std::vector<std::string>());
  AddInspectionReport(input, robot, summary, &outcome.folders[0]);
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
