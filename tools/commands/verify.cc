#include "tools/commands/verify.h"

#include <gflags/gflags.h>

#include "calib/verify.h"
#include "tools/command_report.h"
#include "tools/input_flags.h"
#include "tools/log_flags.h"
#include "tools/output_folder.h"
#include "tools/report/report_data.h"
#include "tools/simulation_flags.h"

DEFINE_string(
    calibration, "",
    "`FILE` calibration.json of armcal calibrate for --robot, or its folder: "
    "its refined parameters instead of the robot file's own");

DEFINE_double(
    budget, 60,
    "`S` for Simbody's simulations of stretches of the log, the rest is "
    "armcal's; 0: all of them");

namespace armcal {
namespace {

VerifyOptions VerifyOptionsFromFlags(const CommandInput& input,
                                     const Robot& robot) {
  const FlagValues& flags = input.flags;
  VerifyOptions options;
  options.calibration = flags.Text("calibration");
  options.reading = LogOptionsFromFlags(flags, robot);
  options.bandwidth_hz = BandwidthFromFlags(flags);
  options.controller = flags.Text("controller");
  options.budget_s = flags.Number("budget");
  options.seed = SeedFromFlags(flags);
  options.draw_torques = input.WantsReport();
  options.progress = input.progress;
  return options;
}

CommandOutcome RunVerify(const CommandInput& input) {
  const FlagValues& flags = input.flags;
  LogInput logs;
  // A controller follows the command of one.
  if (!flags.Text("log").empty() || !flags.Text("controller").empty()) {
    logs = LogInputFromFlags(input);
  }
  const Robot robot = RobotFromFlags(input);
  const VerifyOptions options = VerifyOptionsFromFlags(input, robot);
  const VerifySummary summary = Verify(robot, logs, options);
  CommandOutcome outcome = OutcomeOf(input, robot, summary, robot.notes);
  std::vector<std::string> files = NamesOf(logs.logs);
  if (!options.calibration.empty()) files.push_back(options.calibration);
  AddReport(
      input, "verify", robot, summary.json, files,
      [&](ReportContent* content) {
        if (summary.torques == nullptr) return;
        content->torques = TracesJson(robot, *summary.torques);
      },
      &outcome.folders[0]);
  return outcome;
}

}  // namespace

Command VerifyCommand() {
  return {
      "verify",
      "a robot, or a calibration of it, against an independent engine "
      "(Simbody): torques, mass matrix, gravity, energy; and simulated "
      "over stretches of a log, before and after calibration",
      {{"robot and logs", {"robot", "calibration", "log", "crop", "bandwidth"}},
       {"simulation", {"controller", "budget", "seed"}},
       TorqueFlags(),
       ChainFlags()},
      {"armcal verify --robot=arm.urdf",
       "armcal verify --robot=arm.urdf --log=tue.csv "
       "--calibration=calibration.json"},
      &RunVerify};
}

}  // namespace armcal
