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

DECLARE_string(controller);
DECLARE_string(geometry);
DECLARE_string(poses);

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

OutputErrorOptions OptionsFromFlags(const Robot& robot) {
  const LinearCalibrationOptions linear = LinearOptionsFromFlags(robot);
  if (FLAGS_geometry != "known" || !FLAGS_poses.empty()) {
    throw UsageError(
        "--controller: found --geometry or --poses beside it, expected none: "
        "commands are followed by an arm of known geometry");
  }
  OutputErrorOptions options;
  options.trust.inertia = TrustFromFlags().inertia;
  options.trust.gains = NotNegative("gains_trust", FLAGS_gains_trust);
  options.trust.delay = NotNegative("delay_trust", FLAGS_delay_trust);
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

std::vector<CommandedLog> Read(const std::vector<std::string>& paths,
                               const LogReaderOptions& options,
                               const TimeRange& crop) {
  std::vector<CommandedLog> logs;
  for (const std::string& path : paths) {
    logs.push_back(ReadCommandedLog(path, options, crop));
  }
  return logs;
}

std::vector<std::string> TorqueLogsFromFlags() {
  const std::vector<std::string> paths = SplitAtCommas(FLAGS_torque_log);
  const bool gap = std::count(paths.begin(), paths.end(), "") > 0;
  if (gap || !NamedBefore(paths).empty()) {
    throw UsageError("--torque_log: found '" + FLAGS_torque_log +
                     "', expected names of logs that are named once, with "
                     "commas between them");
  }
  return paths;
}

// Nothing without --torque_log.
std::optional<TorqueInformation> TorquesFromFlags(const Robot& robot,
                                                  const CommandInput& input) {
  const std::vector<std::string> paths = TorqueLogsFromFlags();
  if (paths.empty()) return std::nullopt;
  LinearCalibrationOptions linear = LinearOptionsFromFlags(robot);
  if (linear.identification != Identification::kWeak ||
      linear.solver != LinearSolver::kWeighted) {
    throw UsageError(
        "--torque_log: expected --identification=weak and --solver=weighted "
        "with it, whose equations have weights beside positions");
  }
  linear.progress = input.progress;
  NonlinearCalibrationOptions options;
  options.trust = TrustFromFlags();
  options.progress = input.progress;
  const LogSet logs(LogFiles(paths), LogOptionsFromFlags(robot), TimeRange());
  return InformByTorques(robot, CalibrateLinear(robot, linear, logs, nullptr),
                         options, logs);
}

void ExpectMasses(const Robot& robot) {
  for (const Link& link : robot.links) {
    if (link.inertial.mass > 0) continue;
    throw InputError(RobotPathFromFlags(), "link " + link.name, "",
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

bool CommandedFromFlags() {
  if (FLAGS_controller.empty() && !FLAGS_torque_log.empty()) {
    throw UsageError(
        "--torque_log: found no --controller beside it, expected logs of "
        "commands in --log; logs with torques alone are --log's");
  }
  return !FLAGS_controller.empty();
}

CommandOutcome CalibrateCommandedFromFlags(const CommandInput& input) {
  const Robot robot = RobotFromFlags(input);
  OutputErrorOptions options = OptionsFromFlags(robot);
  options.progress = input.progress;
  ExpectMasses(robot);
  CheckLogsApart();
  LogReaderOptions reading = LogOptionsFromFlags(robot);
  reading.need_torque = false;
  input.Begin("opening the logs");
  const std::vector<CommandedLog> training =
      Read(LogsFromFlags(), reading, CropFromFlags());
  const std::vector<CommandedLog> validation =
      Read(ValidationLogsFromFlags(), reading, ValidationCropFromFlags());
  const ControllerOptions controller =
      ControllerFromFlags(robot, training.at(0).log.qref.row(0));
  if (!OutFromFlags().empty()) {
    const auto logs = validation.empty() ? training.size() : validation.size();
    options.trace_bins =
        MostTraceBins(static_cast<int>(logs), robot.num_joints(), 2);
  }
  const std::optional<TorqueInformation> torques =
      TorquesFromFlags(robot, input);
  const OutputErrorCalibration result =
      CalibrateOutputError(robot, controller, options, training, validation,
                           torques ? &*torques : nullptr);
  CommandOutcome outcome;
  OutputFolder& out = outcome.folders.emplace_back(OutFromFlags());
  nlohmann::json json = OutputErrorJson(robot, training, validation, result);
  const std::vector<std::string> torque_logs = TorqueLogsFromFlags();
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
    AddRobotOutputs(result.arm, drives, &json, &outcome);
  }
  outcome.output.json = json.dump(2) + "\n";
  out.Add("calibration.json", outcome.output.json);
  std::vector<std::string> files = LogsFromFlags();
  for (const std::string& path : ValidationLogsFromFlags()) {
    files.push_back(path);
  }
  files.insert(files.end(), torque_logs.begin(), torque_logs.end());
  AddReport(
      "calibrate", robot, json, files,
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
