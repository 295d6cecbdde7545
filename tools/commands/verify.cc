#include "tools/commands/verify.h"

#include <gflags/gflags.h>

#include <optional>

#include "calib/refine/calibration_reader.h"
#include "calib/verify/verification_report.h"
#include "tools/command_report.h"
#include "tools/input_flags.h"
#include "tools/output_folder.h"
#include "tools/report/report_data.h"
#include "tools/simulation_flags.h"

DEFINE_string(
    calibration, "",
    "`FILE` calibration.json of armcal calibrate for --robot: its refined "
    "parameters are verified; default: the robot file's own");

namespace armcal {
namespace {

double BandwidthFor(const FlagValues& flags, const CalibratedRobot* calibrated,
                    const LogSet& logs) {
  const std::optional<double> given = BandwidthFromFlags(flags);
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

// The log that --controller is to follow, if it is given.
std::optional<CommandedLog> CommandsFromFlags(const CommandInput& input,
                                              const Robot& file) {
  const FlagValues& flags = input.flags;
  if (flags.Text("controller").empty()) return std::nullopt;
  return ReadCommandedLog(LogsFromFlags(input)[0],
                          LogOptionsFromFlags(flags, file),
                          CropFromFlags(flags));
}

ClosedLoopComparison CloseLoop(const FlagValues& flags, const Robot& file,
                               const CalibratedRobot* calibrated,
                               const CommandedLog& log) {
  const ControllerOptions controller =
      ControllerFromFlags(flags, file, log.log.qref.row(0));
  return CompareClosedLoop(file, calibrated, controller, log);
}

CommandOutcome Finish(const CommandInput& input, const Robot& file,
                      const VerificationReport& report,
                      const nlohmann::json& torques) {
  CommandOutcome outcome;
  OutputFolder& out = outcome.folders.emplace_back(OutFromFlags(input.flags));
  const nlohmann::json json = ToJson(report);
  const std::string text = json.dump(2) + "\n";
  out.Add("verification.json", text);
  std::vector<std::string> files = report.logs;
  if (!report.calibration.empty()) files.push_back(report.calibration);
  AddReport(
      input, "verify", file, json, files,
      [&](ReportContent* content) { content->torques = torques; }, &out);
  outcome.output = {text, FullReport(report), file.name + ": ", report.passed(),
                    file.notes};
  return outcome;
}

// The torques of the file's robot, and of the calibrated one.
nlohmann::json Traces(const CommandInput& input, const Robot& file,
                      const CalibratedRobot* calibrated, LogSet* logs) {
  if (!input.WantsReport()) return nlohmann::json::array();
  std::vector<TracedModel> models = {TraceRobot("the robot file", file, {})};
  if (calibrated != nullptr) {
    models.push_back(
        TraceRobot("calibrated", calibrated->robot, calibrated->transitions));
  }
  return TracesJson(file, models, logs, input.progress);
}

// What logs say, where there are any; returns their torques.
nlohmann::json VerifyOnLogs(const CommandInput& input, const Robot& file,
                            const CalibratedRobot* calibrated,
                            const VerificationOptions& options,
                            VerificationReport* report) {
  const FlagValues& flags = input.flags;
  report->logs = LogsFromFlags(input);
  const std::optional<CommandedLog> commanded = CommandsFromFlags(input, file);
  if (commanded) {
    report->closed_loop = CloseLoop(flags, file, calibrated, *commanded);
    if (commanded->log.tau.size() == 0) {
      // Positions alone: the robot is verified on random states.
      report->verification = Verify(report->robot, options, nullptr);
      if (calibrated != nullptr &&
          calibrated->Saw(commanded->path, CropFromFlags(flags))) {
        report->seen_logs = report->logs;
      }
      return nlohmann::json::array();
    }
  }
  LogSet logs(report->logs, LogOptionsFromFlags(flags, file),
              CropFromFlags(flags));
  if (calibrated != nullptr) report->seen_logs = SeenLogs(*calibrated, logs);
  logs.Prepare(BandwidthFor(flags, calibrated, logs), 0);
  report->verification = Verify(report->robot, options, &logs);
  RolloutOptions rollouts;
  rollouts.progress = options.progress;
  report->rollouts = CompareRollouts(file, calibrated, rollouts,
                                     logs.bandwidth_hz(), report->seed, &logs);
  return Traces(input, file, calibrated, &logs);
}

CommandOutcome RunVerify(const CommandInput& input) {
  const FlagValues& flags = input.flags;
  if (!flags.Text("controller").empty() && LogsFromFlags(input).size() != 1) {
    throw UsageError("--controller follows the command of one log: --log=FILE");
  }
  const Robot file = RobotFromFlags(input);
  std::optional<CalibratedRobot> calibrated;
  const std::string calibration = flags.Text("calibration");
  if (!calibration.empty()) {
    calibrated = ReadCalibration(calibration, file);
  }
  VerificationReport report;
  report.robot = calibrated ? calibrated->robot : file;
  report.calibration = calibration;
  report.calibration_converged = !calibrated || calibrated->converged;
  VerificationOptions options;
  options.seed = report.seed = SeedFromFlags(flags);
  input.Begin("verifying");
  options.progress = input.progress;
  nlohmann::json torques = nlohmann::json::array();
  if (flags.Text("log").empty()) {
    report.verification = Verify(report.robot, options, nullptr);
  } else {
    torques = VerifyOnLogs(input, file, calibrated ? &*calibrated : nullptr,
                           options, &report);
  }
  return Finish(input, file, report, torques);
}

}  // namespace

Command VerifyCommand() {
  return {
      "verify",
      "a robot, or a calibration of it, against an independent engine "
      "(Simbody): torques, mass matrix, gravity, energy; and simulated "
      "over stretches of a log, before and after calibration",
      {{"robot and logs", {"robot", "calibration", "log", "crop", "bandwidth"}},
       {"simulation", {"controller", "seed"}},
       TorqueFlags(),
       ChainFlags()},
      {"armcal verify --robot=arm.urdf",
       "armcal verify --robot=arm.urdf --log=tue.csv "
       "--calibration=calibration.json"},
      &RunVerify};
}

}  // namespace armcal
