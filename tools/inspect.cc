#include "tools/inspect.h"

#include <gflags/gflags.h>

#include <iostream>

#include "calib/inspection_report.h"
#include "calib/robot_audit.h"
#include "model/log_writer.h"
#include "tools/input_flags.h"
#include "tools/output_folder.h"

DECLARE_string(log);

DEFINE_bool(fix, false,
            "write the logs as they are understood: order, signs and units");

namespace armcal {
namespace {

// "fixed_1.csv": logs of different folders may have one name.
void AddMended(const Robot& robot, const LogReaderOptions& options,
               const std::vector<LogInspection>& logs, OutputFolder* out) {
  LogReaderOptions wanted = options;
  wanted.want_velocity = true;
  for (size_t k = 0; k < logs.size(); ++k) {
    const Log log = ReadWholeLog(logs[k].path, wanted);
    out->Add("fixed_" + std::to_string(k + 1) + ".csv",
             LogText(Mended(robot, log, logs[k])));
  }
}

int RunInspect() {
  if (FLAGS_fix && OutFromFlags().empty()) {
    throw UsageError("--fix needs --out=FOLDER to write to");
  }
  const Robot robot = RobotFromFlags();
  const std::vector<InspectionFinding> of_robot = AuditRobot(robot);
  std::vector<LogInspection> logs;
  const LogReaderOptions options = LogOptionsFromFlags(robot);
  if (!FLAGS_log.empty()) {
    for (const std::string& path : LogsFromFlags()) {
      LogInspection log = InspectLog(robot, path, options);
      if (log.as_it_is) {
        log.coverage = CoverageOf(robot, path, options);
        log.findings.insert(log.findings.end(), log.coverage.findings.begin(),
                            log.coverage.findings.end());
      }
      logs.push_back(log);
    }
  }
  OutputFolder out(OutFromFlags());
  out.Add("inspect.json", ToJson(robot, of_robot, logs).dump(2) + "\n");
  if (FLAGS_fix) AddMended(robot, options, logs, &out);
  out.Write();
  std::cout << FullReport(robot, of_robot, logs);
  bool clean = of_robot.empty();
  for (const LogInspection& log : logs) clean = clean && log.findings.empty();
  return clean ? kExitOk : kExitNegative;
}

}  // namespace

Command InspectCommand() {
  return {"inspect",
          "what a robot file or a log holds, and what is wrong with it",
          {"robot", "log", "out", "fix", "base", "tip", "gravity",
           "torque_kind", "torque_constants", "gear_ratios"},
          &RunInspect};
}

}  // namespace armcal
