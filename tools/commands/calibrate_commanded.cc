#include "tools/commands/calibrate_commanded.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "calib/closed_loop/output_error.h"
#include "calib/closed_loop/output_error_report.h"
#include "calib/linear/calibrate_linear.h"
#include "model/text/input_text.h"
#include "tools/command_report.h"
#include "tools/commands/calibrate_flags.h"
#include "tools/commands/calibrate_refined.h"
#include "tools/export_flags.h"
#include "tools/input_flags.h"
#include "tools/output_folder.h"
#include "tools/report/report_data.h"
#include "tools/simulation_flags.h"

DEFINE_double(gains_trust, 0,
              "with --controller: relative standard deviation of its gains, "
              "which are then estimated; 0: exact");
DEFINE_double(delay_trust, 0.02,
              "`S` with --controller: standard deviation of the command's "
              "delay, which is then estimated; 0: exact");

DEFINE_string(torque_log, "",
              "`FILES` logs with torques of the same arm, beside --log's of "
              "commands: one estimate is made of both");

namespace armcal {
namespace {

double NotNegative(const std::string& flag, double value) {
  if (value >= 0 && std::isfinite(value)) return value;
  throw UsageError("--" + flag + ": found '" + NumberText(value) +
                   "', expected a standard deviation of at least 0");
}

OutputErrorOptions OptionsFromFlags(const FlagValues& flags,
                                    const Robot& robot) {
  const LinearCalibrationOptions linear = LinearOptionsFromFlags(flags, robot);
  if (flags.Text("geometry") != "known" || !flags.Text("poses").empty()) {
    throw UsageError(
        "--controller: found --geometry or --poses beside it, expected none: "
        "commands are followed by an arm of known geometry");
  }
  OutputErrorOptions options;
  options.trust.inertia = TrustFromFlags(flags).inertia;
  options.trust.gains = NotNegative("gains_trust", flags.Number("gains_trust"));
  options.trust.delay = NotNegative("delay_trust", flags.Number("delay_trust"));
  options.joint_terms = linear.joint_terms;
  if (linear.transition) {
    if (linear.transition->law != CoulombTransition::Law::kVelocity) {
      throw UsageError(
          "--coulomb_width: found a displacement, expected a speed: commands "
          "are followed by an arm with friction of velocity");
    }
    options.coulomb_width = linear.transition->width;
    options.trust.width = 0;
  }
  return options;
}

std::vector<CommandedLog> Read(const std::vector<LogSource>& sources,
                               const LogReaderOptions& options,
                               const TimeRange& crop) {
  std::vector<CommandedLog> logs;
  for (const LogSource& source : sources) {
    logs.push_back(ReadCommandedLog(source, options, crop));
  }
  return logs;
}

std::vector<std::string> TorqueLogsFromFlags(const CommandInput& input) {
  const std::string given = input.flags.Text("torque_log");
  const std::vector<std::string> paths = SplitAtCommas(given);
  const bool gap = std::count(paths.begin(), paths.end(), "") > 0;
  if (gap || !NamedBefore(input, paths).empty()) {
    throw UsageError("--torque_log: found '" + given +
                     "', expected names of logs that are named once, with "
                     "commas between them");
  }
  return paths;
}

// Nothing without --torque_log.
std::optional<TorqueInformation> TorquesFromFlags(const CommandInput& input,
                                                  const Robot& robot) {
  const FlagValues& flags = input.flags;
  const std::vector<std::string> paths = TorqueLogsFromFlags(input);
  if (paths.empty()) return std::nullopt;
  LinearCalibrationOptions linear = LinearOptionsFromFlags(flags, robot);
  if (linear.identification != Identification::kWeak ||
      linear.solver != LinearSolver::kWeighted) {
    throw UsageError(
        "--torque_log: expected --identification=weak and --solver=weighted "
        "with it, whose equations have weights beside positions");
  }
  linear.progress = input.progress;
  NonlinearCalibrationOptions options;
  options.trust = TrustFromFlags(flags);
  options.progress = input.progress;
  const LogSet logs(SourcesOf(input, paths), LogOptionsFromFlags(flags, robot),
                    TimeRange());
  return InformByTorques(robot, CalibrateLinear(robot, linear, logs, nullptr),
                         options, logs);
}

void ExpectMasses(const CommandInput& input, const Robot& robot) {
  for (const Link& link : robot.links) {
    if (link.inertial.mass > 0) continue;
    throw InputError(RobotFileFromFlags(input).name(), "link " + link.name, "",
                     "expected a mass: a simulation starts from it");
  }
}

void AddDrawings(const Robot& robot, const OutputErrorCalibration& result,
                 nlohmann::json* extra) {
  if (!result.arm.solved) return;
  (*extra)["positions"] =
      PositionsJson(robot, {"the robot file", "calibrated"}, result.traces);
  std::vector<std::string> names;
  std::vector<bool> seen;
  for (const PhysicalParameter& p : result.arm.parameters) {
    names.push_back(p.name);
    seen.push_back(p.identifiable);
  }
  (*extra)["correlations"] = nlohmann::json::array({CorrelationsJson(
      "The robot and its drives", names, result.arm.covariance, seen)});
}

}  // namespace

bool CommandedFromFlags(const FlagValues& flags) {
  if (flags.Text("controller").empty() && !flags.Text("torque_log").empty()) {
    throw UsageError(
        "--torque_log: found no --controller beside it, expected logs of "
        "commands in --log; logs with torques alone are --log's");
  }
  return !flags.Text("controller").empty();
}

CommandOutcome CalibrateCommandedFromFlags(const CommandInput& input) {
  const FlagValues& flags = input.flags;
  const Robot robot = RobotFromFlags(input);
  OutputErrorOptions options = OptionsFromFlags(flags, robot);
  options.progress = input.progress;
  ExpectMasses(input, robot);
  CheckLogsApart(input);
  LogReaderOptions reading = LogOptionsFromFlags(flags, robot);
  reading.need_torque = false;
  input.Begin("opening the logs");
  const std::vector<CommandedLog> training = Read(
      SourcesOf(input, LogsFromFlags(input)), reading, CropFromFlags(flags));
  const std::vector<CommandedLog> validation =
      Read(SourcesOf(input, ValidationLogsFromFlags(input)), reading,
           ValidationCropFromFlags(flags));
  const ControllerOptions controller =
      ControllerFromFlags(flags, robot, training.at(0).log.qref.row(0));
  if (input.WantsReport()) {
    const auto logs = validation.empty() ? training.size() : validation.size();
    options.trace_bins =
        MostTraceBins(static_cast<int>(logs), robot.num_joints(), 2);
  }
  const std::optional<TorqueInformation> torques =
      TorquesFromFlags(input, robot);
  const OutputErrorCalibration result =
      CalibrateOutputError(robot, controller, options, training, validation,
                           torques ? &*torques : nullptr);
  CommandOutcome outcome;
  OutputFolder& out = outcome.folders.emplace_back(OutFromFlags(flags));
  nlohmann::json json = OutputErrorJson(robot, training, validation, result);
  const std::vector<std::string> torque_logs = TorqueLogsFromFlags(input);
  if (torques) {
    json["torque_logs"] = torque_logs;
    outcome.output.text =
        "with the torques of " + JoinNames(torque_logs) + "\n";
  }
  outcome.output.text += OutputErrorReport(robot, result);
  if (result.arm.solved) {
    ControllerOptions drives = controller;
    drives.drives = result.values.drives;
    drives.delay = result.values.delay;
    AddRobotOutputs(input, result.arm, drives, &json, &outcome);
  }
  outcome.output.json = json.dump(2) + "\n";
  out.Add("calibration.json", outcome.output.json);
  std::vector<std::string> files = LogsFromFlags(input);
  for (const std::string& path : ValidationLogsFromFlags(input)) {
    files.push_back(path);
  }
  files.insert(files.end(), torque_logs.begin(), torque_logs.end());
  AddReport(
      input, "calibrate", robot, outcome.output.json, files,
      [&](ReportContent* content) {
        AddDrawings(robot, result, &content->extra);
      },
      &out);
  outcome.output.verdict = robot.name + ": ";
  outcome.output.positive = Shortcomings(result).empty();
  outcome.output.notes = robot.notes;
  return outcome;
}

}  // namespace armcal
