#include "tools/commands/diagnose_poses.h"

#include "calib/diagnose_poses.h"
#include "tools/command_report.h"
#include "tools/input_flags.h"
#include "tools/log_flags.h"
#include "tools/pose_flags.h"
#include "tools/trust_flags.h"
#include "tools/usage_error.h"

namespace armcal {

bool DiagnosesPoses(const CommandInput& input) {
  return !input.flags.Text("poses").empty();
}

CommandOutcome RunDiagnosePoses(const CommandInput& input) {
  const FlagValues& flags = input.flags;
  for (const char* other :
       {"log", "reference", "calibration", "controller", "export"}) {
    if (flags.Text(other).empty()) continue;
    throw UsageError("--poses and --" + std::string(other) +
                     ": expected one of them; a diagnosis is of measured "
                     "poses or of logs");
  }
  const Robot robot = RobotFromFlags(input);
  const PoseMeasurements measured = PosesFromFlags(flags, robot);
  DiagnosePosesOptions options;
  const ArmTrust trust = TrustFromFlags(flags);
  options.geometry.prior_length = trust.length;
  options.geometry.prior_angle = trust.angle;
  options.without = SplitAtCommas(flags.Text("without"));
  const std::string held_out = flags.Text("validate");
  if (!held_out.empty()) {
    options.validation = PosesFromFile(flags, robot, held_out);
  }
  options.source = RobotSourceFromFlags(input);
  options.progress = input.progress;
  const DiagnosePosesSummary summary = DiagnosePoses(robot, measured, options);
  CommandOutcome outcome = OutcomeOf(input, robot, summary, {});
  outcome.output.verdict = summary.brief;
  AddReport(input, "diagnose", robot, summary.json, {flags.Text("poses")},
            nullptr, &outcome.folders[0]);
  return outcome;
}

}  // namespace armcal
