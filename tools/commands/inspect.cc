#include "tools/commands/inspect.h"

#include <gflags/gflags.h>

#include "calib/inspect/inspection_report.h"
#include "calib/inspect/robot_audit.h"
#include "model/log_files/log_writer.h"
#include "tools/export_flags.h"
#include "tools/input_flags.h"
#include "tools/output_folder.h"
#include "tools/simulation_flags.h"

DEFINE_bool(fix, false,
            "write the logs as they are understood: order, signs and units");

namespace armcal {
namespace {

// "fixed_1.csv": logs of different folders may have one name.
void AddMended(const CommandInput& input, const Robot& robot,
               const LogReaderOptions& options,
               const std::vector<LogInspection>& logs, OutputFolder* out) {
  LogReaderOptions wanted = options;
  wanted.want_velocity = wanted.commands_do = true;
  for (size_t k = 0; k < logs.size(); ++k) {
    const Log log = ReadWholeLog(SourceOf(input, logs[k].path), wanted);
    out->Add("fixed_" + std::to_string(k + 1) + ".csv",
             LogText(Mended(robot, log, logs[k])));
  }
}

// With the drives of --controller; gains that it leaves open are those of the
// posture of zeros.
RobotDescription DescriptionFromFlags(const FlagValues& flags,
                                      const Robot& robot) {
  if (flags.Text("controller").empty()) return {robot, {}};
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(robot.num_joints());
  return {robot, {}, ControllerFromFlags(flags, robot, zero)};
}

CommandOutcome RunInspect(const CommandInput& input) {
  const FlagValues& flags = input.flags;
  if (flags.Switch("fix") && OutFromFlags(flags).empty()) {
    throw UsageError("--fix needs --out=FOLDER to write to");
  }
  const auto formats = ExportFromFlags(flags);
  if (!formats.empty() && OutFromFlags(flags).empty()) {
    throw UsageError("--export needs --out=FOLDER to write to");
  }
  if (!flags.Text("controller").empty() && formats.empty()) {
    throw UsageError("--controller is for --export=mjcf, which writes drives");
  }
  const Robot robot = RobotFromFlags(input);
  input.Begin("inspecting");
  const std::vector<InspectionFinding> of_robot = AuditRobot(robot);
  std::vector<LogInspection> logs;
  const LogReaderOptions options = LogOptionsFromFlags(flags, robot);
  if (!flags.Text("log").empty()) {
    for (const std::string& path : LogsFromFlags(input)) {
      const LogSource source = SourceOf(input, path);
      input.Begin("inspecting " + path);
      LogInspection log = InspectLog(robot, source, options);
      if (log.as_it_is) {
        log.coverage = CoverageOf(robot, source, options);
        log.findings.insert(log.findings.end(), log.coverage.findings.begin(),
                            log.coverage.findings.end());
      }
      logs.push_back(log);
    }
  }
  CommandOutcome outcome;
  OutputFolder& out = outcome.folders.emplace_back(OutFromFlags(flags));
  nlohmann::json json = ToJson(robot, of_robot, logs);
  const std::string losses =
      AddExports(DescriptionFromFlags(flags, robot), formats, &json, &out);
  const std::string text = json.dump(2) + "\n";
  out.Add("inspect.json", text);
  if (flags.Switch("fix")) AddMended(input, robot, options, logs, &out);
  bool clean = of_robot.empty();
  for (const LogInspection& log : logs) clean = clean && log.findings.empty();
  outcome.output = {
      text, FullReport(robot, of_robot, logs) + losses, "", clean, {}};
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
