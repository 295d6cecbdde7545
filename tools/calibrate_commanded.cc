#include "tools/calibrate_commanded.h"

#include <gflags/gflags.h>

#include <cmath>
#include <string>
#include <vector>

#include "calib/output_error.h"
#include "calib/output_error_report.h"
#include "model/input_text.h"
#include "tools/calibrate_flags.h"
#include "tools/calibrate_refined.h"
#include "tools/command_report.h"
#include "tools/export_flags.h"
#include "tools/input_flags.h"
#include "tools/output_folder.h"
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

void ExpectMasses(const Robot& robot) {
  for (const Link& link : robot.links) {
    if (link.inertial.mass > 0) continue;
    throw InputError(RobotPathFromFlags(), "link " + link.name, "",
                     "expected a mass: a simulation starts from it");
  }
}

}  // namespace

bool CommandedFromFlags() { return !FLAGS_controller.empty(); }

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
  const OutputErrorCalibration result =
      CalibrateOutputError(robot, controller, options, training, validation);
  CommandOutcome outcome;
  OutputFolder& out = outcome.folders.emplace_back(OutFromFlags());
  nlohmann::json json = OutputErrorJson(robot, training, validation, result);
  outcome.output.text = OutputErrorReport(robot, result);
  if (result.arm.solved) AddRobotOutputs(result.arm, &json, &outcome);
  outcome.output.json = json.dump(2) + "\n";
  out.Add("calibration.json", outcome.output.json);
  std::vector<std::string> files = LogsFromFlags();
  for (const std::string& path : ValidationLogsFromFlags()) {
    files.push_back(path);
  }
  AddReport("calibrate", robot, json, files, nullptr, &out);
  outcome.output.verdict = robot.name + ": ";
  outcome.output.positive = Shortcomings(result).empty();
  outcome.output.notes = robot.notes;
  return outcome;
}

}  // namespace armcal
