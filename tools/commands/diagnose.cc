#include "tools/commands/diagnose.h"

#include <gflags/gflags.h>

#include "calib/diagnose.h"
#include "calib/diagnose/modules/modules.h"
#include "tools/command_report.h"
#include "tools/commands/diagnose_poses.h"
#include "tools/export_flags.h"
#include "tools/flag_choices.h"
#include "tools/input_flags.h"
#include "tools/log_flags.h"
#include "tools/report/report_data.h"
#include "tools/simulation_flags.h"
#include "tools/trust_flags.h"
#include "tools/usage_error.h"

DEFINE_bool(
    changes, false,
    "of four logs or more of one kind of motion, in the order they were "
    "recorded: which parameters changed when");
DEFINE_bool(forward, true,
            "simulate the held-out logs as well: along their commands with "
            "--controller, else over windows of 0.5 s");
DEFINE_string(
    modules, "",
    "the laws found as sources for the loop of a simulator that lacks "
    "them: effects.py, effects.c");
DEFINE_string(reference, "",
              "`FILES` logs of the same robot from before: the diagnosis says "
              "what has changed since");
DEFINE_string(without, "", "`A[,B..]` effects that are not considered");

DEFINE_bool(verbose, false,
            "list every effect that these data cannot tell, and why");

namespace armcal {
namespace {

std::vector<std::pair<std::string, std::string>> ModuleChoices() {
  std::vector<std::pair<std::string, std::string>> choices;
  for (const std::string& name : EffectModuleNames()) {
    choices.push_back({name, name});
  }
  return choices;
}

const FlagChoices<std::string> kModules("modules", ModuleChoices(), true);

DiagnoseOptions DiagnoseOptionsFromFlags(const CommandInput& input,
                                         const Robot& robot) {
  const FlagValues& flags = input.flags;
  DiagnoseOptions options;
  options.reference = {
      SourcesOf(input, SplitAtCommas(flags.Text("reference")))};
  options.calibration = flags.Text("calibration");
  options.validation = ValidationInputFromFlags(input);
  options.reading = LogOptionsFromFlags(flags, robot);
  if (!flags.IsDefault("trust")) options.trust = TrustFromFlags(flags).inertia;
  options.bandwidth_hz = BandwidthFromFlags(flags);
  for (const Effect* effect : ParseEffects("without", flags.Text("without"))) {
    options.without.push_back(effect->name);
  }
  options.changes = flags.Switch("changes");
  options.forward = flags.Switch("forward");
  options.verbose = flags.Switch("verbose");
  options.controller = flags.Text("controller");
  options.seed = SeedFromFlags(flags);
  const ExportChoice exports = ExportFromFlags(flags);
  options.exports = exports.formats;
  options.samples = exports.samples;
  for (const std::string& name : SplitAtCommas(flags.Text("modules"))) {
    options.modules.push_back(kModules.Parse(name));
  }
  options.source = RobotSourceFromFlags(input);
  options.draw_torques = input.WantsReport();
  options.progress = input.progress;
  return options;
}

CommandOutcome RunDiagnose(const CommandInput& input) {
  if (DiagnosesPoses(input)) return RunDiagnosePoses(input);
  for (const char* of_poses : {"camera", "compliance"}) {
    if (input.flags.Text(of_poses).empty()) continue;
    throw UsageError("--" + std::string(of_poses) +
                     ": expected --poses beside it, which it is of");
  }
  const LogInput logs = LogInputFromFlags(input);
  const Robot robot = RobotFromFlags(input);
  const DiagnoseOptions options = DiagnoseOptionsFromFlags(input, robot);
  const DiagnoseSummary summary = Diagnose(robot, logs, options);
  CommandOutcome outcome = OutcomeOf(input, robot, summary, {});
  outcome.output.verdict = summary.report.substr(0, summary.report.find('\n'));
  std::vector<std::string> files = NamesOf(logs.logs);
  for (const LogInput* more : {&options.validation, &options.reference}) {
    for (const std::string& name : NamesOf(more->logs)) files.push_back(name);
  }
  if (!options.calibration.empty()) files.push_back(options.calibration);
  for (const std::string& log : summary.calibration_logs) files.push_back(log);
  AddReport(
      input, "diagnose", robot, summary.json, files,
      [&](ReportContent* content) {
        content->torques = TracesJson(robot, *summary.torques);
      },
      &outcome.folders[0]);
  outcome.robot = summary.robot;
  return outcome;
}

}  // namespace

Command DiagnoseCommand() {
  return {"diagnose",
          "where the sim-to-real gap lies, which effect causes it, and how far "
          "it shrinks once that effect is in the model, in logs or poses",
          {{"robot and logs",
            {"robot", "calibration", "log", "reference", "validate",
             "bandwidth", "poses"}},
           {"diagnosis",
            {"trust", "without", "forward", "verbose", "controller", "seed"}},
           {"more of the input",
            {"crop", "validate_crop", "changes", "compliance", "camera",
             "camera_on", "length_trust", "angle_trust"},
            false},
           TorqueFlags(),
           {"robot files", {"export", "modules"}, false},
           ChainFlags()},
          {"armcal diagnose --robot=arm.urdf --log=today.csv "
           "--reference=january.csv",
           "armcal diagnose --robot=arm.urdf --log=today.csv "
           "--calibration=calibrated",
           "armcal diagnose --robot=arm.urdf --poses=tracker.csv"},
          &RunDiagnose};
}

}  // namespace armcal
