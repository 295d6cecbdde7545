#include "tools/commands/reduce.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <filesystem>

#include "calib/fleet/factor_calibration.h"
#include "calib/fleet/factor_file.h"
#include "calib/fleet/factor_report.h"
#include "calib/fleet/log_reduction.h"
#include "model/text/calendar_time.h"
#include "model/text/input_error.h"
#include "tools/commands/calibrate_flags.h"
#include "tools/input_flags.h"
#include "tools/input_hash.h"
#include "tools/log_flags.h"
#include "tools/report/report_page.h"

DEFINE_string(like, "",
              "`FILE` factor file whose model these logs are reduced by, so "
              "that they can be merged with it");
DEFINE_string(unit, "", "`NAME` of the robot that the logs are of");
DEFINE_string(date, "",
              "`DATE` of the logs, UTC: 2026-11-21 or 2026-11-21T10:30");

namespace armcal {
namespace {

namespace fs = std::filesystem;

std::optional<double> TimeFromFlags(const FlagValues& flags) {
  const std::string date = flags.Text("date");
  if (date.empty()) return std::nullopt;
  const std::optional<double> time = ParseCalendarTime(date);
  if (time) return time;
  throw UsageError("--date: found '" + date +
                   "', expected a date such as 2026-11-21 or 2026-11-21T10:30");
}

// Of --like, or chosen for all logs of --log together.
ReductionModel ModelFromFlags(const CommandInput& input, const Robot& robot) {
  const FlagValues& flags = input.flags;
  const std::string sha256 = HashDocument(RobotFileFromFlags(input)).sha256;
  if (flags.Text("like").empty()) {
    LinearCalibrationOptions options = LinearOptionsFromFlags(flags, robot);
    options.progress = input.progress;
    const LogSet logs(SourcesOf(input, LogsFromFlags(input)),
                      LogOptionsFromFlags(flags, robot), CropFromFlags(flags));
    return ChooseReductionModel(robot, sha256, options, logs);
  }
  for (const char* flag :
       {"geometry", "identification", "joint_terms", "coulomb_width", "window",
        "interval", "quadrature", "loss", "bandwidth"}) {
    if (!flags.IsDefault(flag)) {
      throw UsageError("--" + std::string(flag) +
                       ": expected no such flag beside --like, whose file "
                       "says it");
    }
  }
  const std::string like = flags.Text("like");
  const ReductionModel model = ReadFactorFile(like).model;
  if (model.robot_sha256 != sha256) {
    throw InputError(
        like, "key model.robot_sha256", model.robot_sha256,
        "expected " + sha256 + ", that of " + RobotFileFromFlags(input).name());
  }
  ParametersOf(robot, model, like);
  return model;
}

// "log-0123456789ab.factor": logs of one name have files of their own, and the
// same log has the same one again.
std::string FactorName(const ReducedLog& log) {
  return fs::path(log.file).stem().stem().string() + "-" +
         log.sha256.substr(0, 12) + ".factor";
}

CommandOutcome RunReduce(const CommandInput& input) {
  const FlagValues& flags = input.flags;
  const Robot robot = RobotFromFlags(input);
  const std::optional<double> time = TimeFromFlags(flags);
  CheckApart(LogInputFromFlags(input), {});
  input.Begin("opening the logs");
  const ReductionModel model = ModelFromFlags(input, robot);
  CommandOutcome outcome;
  OutputFolder& out = outcome.folders.emplace_back(OutFromFlags(flags));
  Reduction all{model, {}};
  for (const std::string& path : LogsFromFlags(input)) {
    const LogSet log({SourceOf(input, path)}, LogOptionsFromFlags(flags, robot),
                     CropFromFlags(flags));
    ReducedLog reduced = ReduceLog(robot, model, input.progress, log);
    reduced.sha256 = HashInput(input, path).sha256;
    reduced.unit = flags.Text("unit");
    reduced.time = time;
    out.Add(FactorName(reduced), FactorFileBytes({model, {reduced}}));
    all.logs.push_back(reduced);
  }
  outcome.output.json = ToJson(all).dump(2) + "\n";
  outcome.output.text = ReductionText(robot, all);
  for (const auto& file : out.files()) {
    outcome.output.text += "factor     " + file.first + "\n";
  }
  outcome.output.notes = robot.notes;
  return outcome;
}

}  // namespace

Command ReduceCommand() {
  return {"reduce",
          "logs to factor files: what a calibration needs of them, in "
          "kilobytes, for merge",
          {{"robot and logs",
            {"robot", "log", "like", "unit", "date", "bandwidth"}},
           {"more of the logs", {"crop"}, false},
           TorqueFlags(),
           {"equations",
            {"geometry", "identification", "loss", "joint_terms",
             "coulomb_width", "window", "interval", "quadrature"},
            false},
           ChainFlags()},
          {"armcal reduce --robot=arm.urdf --log=mon.csv --out=factors",
           "armcal reduce --robot=arm.urdf --like=factors/mon-8f2.factor "
           "--log=tue.csv --unit=A7 --date=2026-11-21 --out=factors"},
          &RunReduce};
}

}  // namespace armcal
