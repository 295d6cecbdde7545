#include "tools/commands/diagnose.h"

#include <gflags/gflags.h>

#include <cmath>
#include <optional>

#include "calib/diagnose/report.h"
#include "calib/diagnose/robot_export.h"
#include "model/effects/effects.h"
#include "model/robot_files/robot_reader.h"
#include "tools/command_report.h"
#include "tools/commands/calibrate_refined.h"
#include "tools/commands/commanded_torques.h"
#include "tools/export_flags.h"
#include "tools/input_flags.h"
#include "tools/output_folder.h"
#include "tools/report/report_data.h"
#include "tools/simulation_flags.h"

DEFINE_bool(forward, true,
            "simulate the held-out logs as well: along their commands with "
            "--controller, else over windows of 0.5 s");
DEFINE_string(reference, "",
              "`FILES` logs of the same robot from before: the model is "
              "fitted to it "
              "first, and the diagnosis says what has changed since");
DEFINE_string(without, "", "`A[,B..]` effects that are not considered");

namespace armcal {
namespace {

// Unless given: a file is good to 5 %, and counts for little beside a
// reference.
double TrustInFile(const FlagValues& flags) {
  if (!flags.IsDefault("trust")) return TrustFromFlags(flags).inertia;
  return flags.Text("reference").empty() ? .05 : .5;
}

std::vector<std::string> LeftOutEffects(const FlagValues& flags) {
  std::vector<std::string> names;
  for (const Effect* effect : ParseEffects("without", flags.Text("without"))) {
    names.push_back(effect->name);
  }
  return names;
}

// The commands of what is held out, for a controller to follow.
void SetController(const CommandInput& input, const Robot& robot,
                   const LogReaderOptions& log_options,
                   DiagnosisOptions* options) {
  const FlagValues& flags = input.flags;
  if (flags.Text("controller").empty()) return;
  const bool held_out = !ValidationLogsFromFlags(input).empty();
  for (const std::string& path :
       held_out ? ValidationLogsFromFlags(input) : LogsFromFlags(input)) {
    options->commanded.push_back(ReadCommandedLog(
        SourceOf(input, path), log_options,
        held_out ? ValidationCropFromFlags(flags) : CropFromFlags(flags)));
  }
  options->controller =
      ControllerFromFlags(flags, robot, options->commanded[0].log.qref.row(0));
}

// What is held out, by the models of the diagnosis.
nlohmann::json Torques(const FlagValues& flags, const Robot& robot,
                       const GapDiagnosis& diagnosis, const LogSet& logs) {
  const bool reference = !flags.Text("reference").empty();
  DrawnTorques drawn;
  drawn.labels = {reference ? "as in the reference" : "the robot file",
                  "fitted again"};
  if (!diagnosis.effects.empty()) drawn.labels.push_back("with the effects");
  for (int log = 0; log < logs.size(); ++log) {
    drawn.logs.push_back(logs.path(log));
  }
  drawn.traces = diagnosis.traces;
  return TracesJson(robot, drawn);
}

std::vector<std::string> FilesRead(const CommandInput& input) {
  std::vector<std::string> files = LogsFromFlags(input);
  for (const std::vector<std::string>& more :
       {ValidationLogsFromFlags(input),
        SplitAtCommas(input.flags.Text("reference"))}) {
    files.insert(files.end(), more.begin(), more.end());
  }
  return files;
}

CommandOutcome Finish(const CommandInput& input, const Robot& robot,
                      const GapDiagnosis& diagnosis, const LogSet& logs) {
  CommandOutcome outcome;
  OutputFolder& out = outcome.folders.emplace_back(OutFromFlags(input.flags));
  const Document file = RobotFileFromFlags(input);
  const RobotExport corrected = ExportCorrectedRobot(
      diagnosis.corrected, robot,
      KindOfRobotFile(file) == RobotFileKind::kUrdf ? file : "",
      BaseFromFlags(input.flags), ExportBesideUrdfFromFlags(input.flags));
  nlohmann::json json = ToJson(diagnosis);
  json["not_in_urdf"] = corrected.losses;
  const std::string losses = AddFiles(corrected.files, &json, &out);
  const std::string text = json.dump(2) + "\n";
  out.Add("diagnosis.json", text);
  out.Add("robot.urdf", corrected.urdf);
  out.Add("effects.json", corrected.effects.dump(2) + "\n");
  const auto draw = [&](ReportContent* content) {
    content->torques = Torques(input.flags, robot, diagnosis, logs);
  };
  AddReport(input, "diagnose", robot, text, FilesRead(input), draw, &out);
  const bool tested = diagnosis.verdict != GapVerdict::kNotTestable;
  const std::string report = FullReport(diagnosis) + losses;
  outcome.output = {
      text, report, report.substr(0, report.find('\n')), tested, {}};
  outcome.brief = BriefReport(diagnosis);
  outcome.robot = diagnosis.corrected.plant.robot;
  return outcome;
}

CommandOutcome RunDiagnose(const CommandInput& input) {
  const FlagValues& flags = input.flags;
  CheckLogsApart(input);
  ExportFromFlags(flags);  // refused before anything is calculated
  DiagnosisOptions options;
  options.without = LeftOutEffects(flags);
  const Robot robot = RobotFromFlags(input);
  LogReaderOptions log_options = LogOptionsFromFlags(flags, robot);
  log_options.want_temperature = true;
  input.Begin("opening the logs");
  MakeTorquesOfCommands(input, robot, FilesRead(input), &log_options);
  const LogSet training(SourcesOf(input, LogsFromFlags(input)), log_options,
                        CropFromFlags(flags));
  options.progress = input.progress;
  options.baseline.trust = TrustInFile(flags);
  options.bandwidth_hz = BandwidthFromFlags(flags).value_or(
      DiagnosisBandwidth(training.time_bases()));
  std::optional<LogSet> reference, validation;
  if (!flags.Text("reference").empty()) {
    reference.emplace(SourcesOf(input, SplitAtCommas(flags.Text("reference"))),
                      log_options, TimeRange());
  }
  const std::vector<std::string> held_out = ValidationLogsFromFlags(input);
  if (!held_out.empty()) {
    validation.emplace(SourcesOf(input, held_out), log_options,
                       ValidationCropFromFlags(flags));
  }
  SetController(input, robot, log_options, &options);
  options.forward = flags.Switch("forward");
  options.seed = SeedFromFlags(flags);
  const GapDiagnosis diagnosis =
      DiagnoseGap(robot, options, training, validation ? &*validation : nullptr,
                  reference ? &*reference : nullptr);
  return Finish(input, robot, diagnosis, validation ? *validation : training);
}

}  // namespace

Command DiagnoseCommand() {
  return {"diagnose",
          "where the sim-to-real gap lies, which effect causes it, and how far "
          "it shrinks once that effect is in the model",
          {{"robot and logs",
            {"robot", "log", "reference", "validate", "bandwidth", "crop"}},
           {"diagnosis", {"trust", "without", "forward", "controller", "seed"}},
           {"more of the logs", {"validate_crop"}, false},
           TorqueFlags(),
           {"robot files", {"export"}, false},
           ChainFlags()},
          {"armcal diagnose --robot=arm.urdf --log=today.csv "
           "--reference=january.csv",
           "armcal diagnose --robot=arm.urdf --log=today.csv --json | "
           "jq .verdict"},
          &RunDiagnose};
}

}  // namespace armcal
