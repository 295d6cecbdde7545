#include "tools/verify.h"

#include <gflags/gflags.h>

#include <iostream>
#include <optional>

#include "calib/calibration_reader.h"
#include "calib/verification_report.h"
#include "tools/input_flags.h"
#include "tools/output_folder.h"
#include "tools/progress_bar.h"
#include "tools/simulation_flags.h"

DECLARE_string(controller);
DECLARE_string(log);

DEFINE_string(calibration, "",
              "calibration.json of armcal calibrate for --robot: its refined "
              "parameters are verified; default: the robot file's own");

namespace armcal {
namespace {

double BandwidthFor(const CalibratedRobot* calibrated, const LogSet& logs) {
  const std::optional<double> given = BandwidthFromFlags();
  if (given) return *given;
  return calibrated ? calibrated->bandwidth_hz
                    : DefaultBandwidth(logs.time_bases());
}

std::vector<std::string> SeenLogs(const CalibratedRobot& calibrated,
                                  const LogSet& logs) {
  std::vector<std::string> seen;
  for (int k = 0; k < logs.size(); ++k) {
    if (calibrated.Saw(logs.path(k), logs.time_bases()[k].range)) {
      seen.push_back(logs.path(k));
    }
  }
  return seen;
}

// Of the first log; the engine refuses what Verify() tells of.
std::optional<ClosedLoopComparison> CloseLoop(
    const Robot& file, const CalibratedRobot* calibrated,
    const std::vector<std::string>& logs) {
  const CommandedLog log =
      ReadCommandedLog(logs[0], LogOptionsFromFlags(file), CropFromFlags());
  const ControllerOptions controller =
      ControllerFromFlags(file, log.log.qref.row(0));
  return CompareClosedLoop(file, calibrated, controller, log);
}

int Finish(const Robot& file, const VerificationReport& report) {
  OutputFolder out(OutFromFlags());
  out.Add("verification.json", ToJson(report).dump(2) + "\n");
  out.Write();
  for (const std::string& note : file.notes) {
    std::cout << "note       " << note << "\n";
  }
  std::cout << FullReport(report);
  return report.passed() ? kExitOk : kExitNegative;
}

// What logs say, where there are any.
void VerifyOnLogs(const Robot& file, const CalibratedRobot* calibrated,
                  const VerificationOptions& options,
                  VerificationReport* report) {
  report->logs = LogsFromFlags();
  LogSet logs(report->logs, LogOptionsFromFlags(file), CropFromFlags());
  if (calibrated != nullptr) report->seen_logs = SeenLogs(*calibrated, logs);
  logs.Prepare(BandwidthFor(calibrated, logs), 0);
  report->verification = Verify(report->robot, options, &logs);
  RolloutOptions rollouts;
  rollouts.progress = options.progress;
  report->rollouts = CompareRollouts(file, calibrated, rollouts,
                                     logs.bandwidth_hz(), report->seed, &logs);
  if (FLAGS_controller.empty()) return;
  report->closed_loop = CloseLoop(file, calibrated, report->logs);
}

int RunVerify() {
  if (!FLAGS_controller.empty() && LogsFromFlags().size() != 1) {
    throw UsageError("--controller follows the command of one log: --log=FILE");
  }
  const Robot file = RobotFromFlags();
  std::optional<CalibratedRobot> calibrated;
  if (!FLAGS_calibration.empty()) {
    calibrated = ReadCalibration(FLAGS_calibration, file);
  }
  VerificationReport report;
  report.robot = calibrated ? calibrated->robot : file;
  report.calibration = FLAGS_calibration;
  report.calibration_converged = !calibrated || calibrated->converged;
  VerificationOptions options;
  options.seed = report.seed = SeedFromFlags();
  ProgressBar bar;
  options.progress = [&bar](const std::string& stage, double fraction) {
    bar.Show(stage, fraction);
  };
  if (FLAGS_log.empty()) {
    report.verification = Verify(report.robot, options, nullptr);
  } else {
    VerifyOnLogs(file, calibrated ? &*calibrated : nullptr, options, &report);
  }
  return Finish(file, report);
}

}  // namespace

Command VerifyCommand() {
  return {"verify",
          "a robot, or a calibration of it, against an independent engine "
          "(Simbody): torques, mass matrix, gravity, energy; and simulated "
          "over stretches of a log, before and after calibration",
          {"robot", "calibration", "log", "controller", "crop", "bandwidth",
           "out", "seed", "base", "tip", "gravity", "torque_kind",
           "torque_constants", "gear_ratios"},
          &RunVerify};
}

}  // namespace armcal
