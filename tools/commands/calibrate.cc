#include "tools/commands/calibrate.h"

#include <memory>

#include "calib/calibration_details.h"
#include "tools/command_report.h"
#include "tools/commands/calibrate_options.h"
#include "tools/commands/calibrate_report.h"
#include "tools/input_flags.h"

namespace armcal {
namespace {

CommandOutcome RunCalibrate(const CommandInput& input) {
  const Robot robot = RobotFromFlags(input);
  const LogInput logs = CalibrationLogsFromFlags(input);
  const CalibrateOptions options = CalibrateOptionsFromFlags(input, robot);
  const CalibrateSummary summary = Calibrate(robot, logs, options);
  CommandOutcome outcome = OutcomeOf(input, robot, summary, robot.notes);
  AddReport(
      input, "calibrate", robot, summary.json, CalibrationFilesFromFlags(input),
      [&](ReportContent* content) {
        if (summary.details == nullptr) return;
        DrawCalibration(robot, *summary.details, content);
      },
      &outcome.folders[0]);
  outcome.robot = summary.robot;
  if (summary.details != nullptr && summary.details->model) {
    outcome.model =
        std::make_shared<const TracedModel>(*summary.details->model);
  }
  return outcome;
}

}  // namespace

Command CalibrateCommand() {
  return {
      "calibrate",
      "dynamics and geometry of an arm from logs of its joint positions and "
      "torques, and from measured poses, with standard deviations, ranks, "
      "a held-out check and a robot file for simulators",
      {{"robot and logs", {"robot", "log", "validate", "bandwidth"}},
       {"what is estimated", {"geometry", "estimate", "trust", "poses"}},
       {"more of the logs",
        {"crop", "validate_crop", "select", "segment"},
        false},
       TorqueFlags(),
       {"commanded logs",
        {"controller", "gains_trust", "delay_trust", "torque_log"},
        false},
       {"equations and solver",
        {"identification", "solver", "loss", "trajectory", "joint_terms",
         "coulomb_width", "window", "interval", "intervals", "quadrature",
         "length_trust", "angle_trust"},
        false},
       {"payload", {"payload_mass", "payload_log"}, false},
       {"images", {"camera", "camera_on"}, false},
       {"robot files", {"export"}, false},
       ChainFlags()},
      {"armcal calibrate --robot=arm.urdf --log=mon.csv --validate=tue.csv "
       "--out=made",
       "armcal calibrate --robot=arm.urdf --log=commands.csv "
       "--controller=drives.yaml",
       "armcal calibrate --robot=arm.urdf --log=log.csv --json | jq .rank"},
      &RunCalibrate};
}

}  // namespace armcal
