#include "tools/commands/calibrate_payload.h"

#include <gflags/gflags.h>

#include <string>
#include <vector>

#include "calib/drive_gains/estimate_drive_gains.h"
#include "calib/drive_gains/report.h"
#include "tools/command.h"
#include "tools/command_report.h"
#include "tools/input_flags.h"

DEFINE_string(payload_mass, "",
              "`KG` of the payload in --payload_log: the torque constants are "
              "estimated from the currents of --log (bare arm) and "
              "--payload_log");
DEFINE_string(payload_log, "",
              "`FILES` logs of the same arm with a payload of "
              "--payload_mass fixed to its last link");

namespace armcal {
namespace {

std::vector<std::string> PayloadLogs(const CommandInput& input) {
  const std::vector<std::string> logs =
      FileNames("payload_log", input.flags.Text("payload_log"));
  const std::string twice = NamedBefore(input, logs);
  if (!twice.empty()) {
    throw UsageError("--payload_log names " + twice +
                     ", which is named before; logs of the bare arm (--log, "
                     "--validate) and with the payload are different ones");
  }
  return logs;
}

void CheckOtherFlags(const LinearCalibrationOptions& options,
                     const LogReaderOptions& log_options) {
  if (!log_options.torque_constants.empty()) {
    throw UsageError(
        "--torque_constants is what --payload_log estimates; give one of them");
  }
  if (log_options.torque_kind != TorqueKind::kAuto &&
      log_options.torque_kind != TorqueKind::kCurrent) {
    throw UsageError(
        "--payload_log estimates torque constants from currents; expected "
        "--torque_kind=current");
  }
  if (options.geometry != GeometryKnowledge::kKnown) {
    throw UsageError("--payload_log takes --geometry=known");
  }
}

}  // namespace

std::optional<DriveGains> DriveGainsFromFlags(
    const CommandInput& input, const Robot& robot,
    const LinearCalibrationOptions& options, LogReaderOptions* log_options) {
  const std::string weighed = input.flags.Text("payload_mass");
  const std::string logs = input.flags.Text("payload_log");
  if (weighed.empty() && logs.empty()) return std::nullopt;
  if (weighed.empty() || logs.empty()) {
    throw UsageError("--payload_mass=KG and --payload_log=FILE go together");
  }
  const double mass = PositiveNumber("payload_mass", weighed);
  const std::vector<std::string> payload_logs = PayloadLogs(input);
  CheckOtherFlags(options, *log_options);
  log_options->torque_kind = TorqueKind::kCurrent;
  log_options->torque_constants.assign(robot.num_joints(), 1);
  const LogSet bare(SourcesOf(input, LogsFromFlags(input)), *log_options,
                    CropFromFlags(input.flags));
  const LogSet payload(SourcesOf(input, payload_logs), *log_options,
                       TimeRange());
  const DriveGains gains =
      EstimateDriveGains(robot, options, mass, bare, &payload);
  if (gains.solved) log_options->torque_constants = gains.TorqueConstants();
  return gains;
}

CommandOutcome UnsolvedGains(const CommandInput& input, const Robot& robot,
                             const DriveGains& gains) {
  nlohmann::json json = {{"format", "armcal calibration 1"},
                         {"robot", robot.name}};
  AddDriveGains(gains, &json);
  CommandOutcome outcome;
  OutputFolder& out = outcome.folders.emplace_back(OutFromFlags(input.flags));
  const std::string text = json.dump(2) + "\n";
  out.Add("calibration.json", text);
  out.Add("covariance.csv", "\n");  // no older matrix beside a refusal
  std::vector<std::string> files = LogsFromFlags(input);
  for (const std::string& log : PayloadLogs(input)) files.push_back(log);
  AddReport(input, "calibrate", robot, text, files, nullptr, &out);
  outcome.output = {
      text, DriveGainsReport(gains), robot.name + ": ", false, {}};
  return outcome;
}

}  // namespace armcal
