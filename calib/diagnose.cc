#include "calib/diagnose.h"

#include <tbb/task_group.h>

#include <algorithm>
#include <utility>

#include "calib/diagnose/changes/changes.h"
#include "calib/diagnose/changes/report.h"
#include "calib/diagnose/diagnosis.h"
#include "calib/diagnose/modules/modules.h"
#include "calib/diagnose/names.h"
#include "calib/diagnose/report.h"
#include "calib/diagnose/sentence.h"
#include "calib/diagnose/since_calibration.h"
#include "calib/diagnosed_calibration.h"
#include "calib/diagnosed_samples.h"
#include "calib/force_torque/change.h"
#include "calib/inspect/stuck_rows.h"
#include "calib/log_clocks.h"
#include "calib/log_readings.h"
#include "calib/logs/drawn_torques.h"
#include "calib/reconstructed_torques.h"
#include "calib/robot_outputs.h"
#include "model/effects/effects.h"
#include "model/robot_files/controller_reader.h"
#include "model/text/format.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

// A file is good to 5 %, and counts for little beside a reference.
double TrustInFile(const DiagnoseOptions& options, bool has_reference) {
  return options.trust.value_or(has_reference ? .5 : BaselineOptions().trust);
}

std::vector<LogSource> AllLogs(const LogInput& logs,
                               const DiagnoseOptions& options) {
  std::vector<LogSource> all = logs.logs;
  for (const LogInput* more : {&options.validation, &options.reference}) {
    all.insert(all.end(), more->logs.begin(), more->logs.end());
  }
  return all;
}

std::optional<LogSet> Open(const LogInput& input,
                           const LogReaderOptions& reading) {
  if (input.logs.empty()) return std::nullopt;
  return LogSet(input.logs, reading, input.crop);
}

// A calibration's own logs, beside which no reference is given.
CalibrationLogs LogsBeside(const std::optional<CalibratedRobot>& calibrated,
                           const std::vector<LogSource>& used,
                           const LogReaderOptions& reading,
                           const DiagnoseOptions& options) {
  if (!calibrated || !options.reference.logs.empty()) return {};
  return ReadableLogs(options.calibration, *calibrated, used, reading);
}

// The commands of what is held out, for a controller to follow.
void SetController(const Robot& robot, const LogInput& held_out,
                   const DiagnoseOptions& options,
                   const LogReaderOptions& reading, DiagnosisOptions* fit) {
  if (options.controller.empty()) return;
  for (const LogSource& log : held_out.logs) {
    fit->commanded.push_back(ReadCommandedLog(log, reading, held_out.crop));
  }
  fit->controller = ReadController(options.controller, robot,
                                   fit->commanded[0].log.qref.row(0));
}

// What was mended of logs before they are used, and what was found of them.
struct MendedLogs {
  std::vector<WrongClock> clocks;
  std::vector<DataFinding> rows;
};

// Positions and velocities tell the clock, so that positions that jump are
// mended before it is asked; what stands still is looked for in the time that
// they tell. Torques that a controller's law makes are made of all that, and
// none of them is stuck.
MendedLogs MendLogs(const Robot& robot, const std::vector<UsedLog>& used,
                    const std::vector<LogSource>& all,
                    const DiagnoseOptions& options, LogReaderOptions* reading) {
  LogReaderOptions positions = *reading;
  MendPositions(robot, used, &positions);
  MendedLogs mended;
  mended.clocks = MendClocks(all, positions, reading);
  if (options.controller.empty()) {
    mended.rows = LeaveOutStuckRows(robot, used, options.bandwidth_hz, reading);
    return mended;
  }
  mended.rows = MendPositions(robot, used, reading);
  for (DataFinding& told :
       ReconstructTorques(robot, options.controller, all, reading)) {
    mended.rows.push_back(std::move(told));
  }
  return mended;
}

// Those that need no file.
DiagnosisOptions FitOptions(const DiagnoseOptions& options) {
  DiagnosisOptions fit;
  fit.without = options.without;
  fit.progress = options.progress;
  fit.baseline.trust = TrustInFile(options, !options.reference.logs.empty());
  fit.may_trust_less = !options.trust && options.calibration.empty();
  fit.trust_in_links = options.trust.value_or(fit.trust_in_links);
  fit.bandwidth_hz = options.bandwidth_hz;
  fit.forward = options.forward;
  fit.seed = options.seed;
  fit.samples = options.samples;
  return fit;
}

// Of a log whose clock was wrong, and whose time is an estimate, no law is told
// beyond the terms of joints that any file may lack, what a day brings (a load,
// another mounting, warm joints), what stands out of the noise for a moment,
// and errors of the recording but for another clock: where time is off by a
// little, any law of motion seems to fit a little, and any force's course a
// stretch of it. Without loads a torque sensor's gain would stand for one.
void LeaveOutLaws(DiagnosisOptions* fit) {
  fit->selection.events = false;
  for (const Effect& effect : Effects()) {
    const bool of_recording =
        effect.nature == Effect::Nature::kRecording && !effect.is_clock;
    const bool of_day =
        effect.nature == Effect::Nature::kDay && !SwingsInTime(effect);
    const bool of_moment = effect.nature == Effect::Nature::kEvent;
    if (!effect.joint_term && !of_recording && !of_day && !of_moment) {
      fit->without.push_back(effect.name);
    }
  }
}

void AddClocks(const std::vector<WrongClock>& clocks,
               const std::vector<LogSource>& logs,
               const DiagnoseOptions& options, GapDiagnosis* diagnosis) {
  for (auto clock = clocks.rbegin(); clock != clocks.rend(); ++clock) {
    diagnosis->data.insert(diagnosis->data.begin(), clock->finding);
  }
  const std::optional<FoundEffect> effect = FoundClock(clocks, logs);
  const auto& without = options.without;
  if (!effect ||
      std::count(without.begin(), without.end(), effect->effect->name) > 0) {
    return;
  }
  diagnosis->effects.insert(diagnosis->effects.begin(), *effect);
  diagnosis->candidates.insert(
      diagnosis->candidates.begin(),
      {effect->effect, effect->joint, effect->probability, effect->score});
}

// The links' masses, centres and inertias were further off than a file's are.
void NoteTrust(double assumed, GapDiagnosis* diagnosis) {
  if (diagnosis->trust <= assumed) return;
  diagnosis->data.push_back(
      {Format("the robot file's masses and inertias are off by more than %.0f "
              "%%",
              100 * assumed),
       Format("the logs are likelier where they may be off by %.0f %%; so they "
              "may here, and effects on masses are told less surely",
              100 * diagnosis->trust),
       OptionName("calibration") + " of a calibrated robot, or " +
           OptionName("trust")});
}

DrawnTorques Draw(const GapDiagnosis& diagnosis, const LogSet& held_out) {
  DrawnTorques drawn;
  drawn.labels = {diagnosis.has_reference     ? "as in " + SinceWhat(diagnosis)
                  : diagnosis.has_calibration ? "as calibrated"
                                              : "the robot file",
                  "fitted again"};
  if (!diagnosis.effects.empty()) drawn.labels.push_back("with the effects");
  for (int log = 0; log < held_out.size(); ++log) {
    drawn.logs.push_back(held_out.path(log));
  }
  drawn.traces = diagnosis.traces;
  return drawn;
}

// From log to log; nothing where there are too few.
std::optional<LogChanges> ChangesOf(const Robot& robot, const LogInput& logs,
                                    const LogReaderOptions& reading,
                                    const DiagnoseOptions& options) {
  if (!options.changes ||
      static_cast<int>(logs.logs.size()) < kFewestLogsOfChanges) {
    return std::nullopt;
  }
  try {
    return FindLogChanges(robot, logs.logs, reading, logs.crop,
                          options.bandwidth_hz, options.progress);
  } catch (const InputError& error) {
    // The diagnosis stands without it: a log that is too short by itself.
    LogChanges none;
    none.logs = NamesOf(logs.logs);
    none.refusal = error.what();
    return none;
  }
}

void AddChanges(const LogChanges& changes, nlohmann::json* json,
                DiagnoseSummary* summary) {
  const std::string brief = BriefChanges(changes);
  const std::string before = brief.empty() ? "" : brief + " ";
  (*json)["changes"] = ToJson(changes);
  (*json)["sentence"] = before + std::string((*json)["sentence"]);
  summary->brief = before + summary->brief;
  summary->report = before + summary->report + FullChanges(changes);
}

// What a force-torque sensor tells by itself, where the logs and a reference
// have its columns: no part of the diagnosis' evidence.
std::optional<ForceTorqueChange> ForceTorqueChangeOf(const Robot& robot,
                                                     double bandwidth_hz,
                                                     const Progress& progress,
                                                     const LogSet& logs,
                                                     const LogSet* reference) {
  if (reference == nullptr || !logs.has_wrench() || !reference->has_wrench() ||
      !CarriesForceTorque(robot)) {
    return std::nullopt;
  }
  PreparationOptions preparation;
  preparation.bandwidth_hz = bandwidth_hz;
  return CompareForceTorque(
      GatherForceTorque(robot, progress, Prepare(*reference, preparation)),
      GatherForceTorque(robot, progress, Prepare(logs, preparation)));
}

void AddModules(const CorrectedRobot& corrected,
                const std::vector<std::string>& names, nlohmann::json* json,
                DiagnoseSummary* summary) {
  const std::vector<EffectModule> modules = MakeEffectModules(corrected, names);
  for (const EffectModule& module : modules) {
    for (const auto& [name, text] : module.files) {
      summary->files.push_back({name, text});
    }
  }
  if (modules.empty()) return;
  (*json)["modules"] = EffectModulesJson(modules);
  const EffectModule& first = modules.front();  // others lose the same
  for (const std::string& loss : first.losses) {
    summary->report += first.files.front().first + "  " + loss + "\n";
  }
}

DiagnoseSummary Summarise(const Robot& robot, const DiagnoseOptions& options,
                          const std::optional<LogChanges>& changes,
                          const std::optional<ForceTorqueChange>& sensor,
                          const std::vector<std::string>& logs,
                          const GapDiagnosis& diagnosis) {
  DiagnoseSummary summary;
  const RobotExport corrected = ExportCorrectedRobot(
      diagnosis.corrected, robot, options.source.urdf.value_or(Document("")),
      options.source.base, FormatsBesideUrdf(options.exports));
  nlohmann::json json = ToJson(diagnosis);
  json["format"] = "armcal diagnosis 1";
  json["robot"] = robot.name;
  json["not_in_urdf"] = corrected.losses;
  json["calibration"] = nullptr;
  if (!options.calibration.empty()) json["calibration"] = options.calibration;
  json["calibration_logs"] = CalibrationLogsJson(diagnosis);
  json["changes"] = nullptr;
  const std::string losses =
      AddRobotFiles(corrected.files, &json, &summary.files);
  summary.report = FullReport(diagnosis, options.verbose) + losses;
  AddModules(diagnosis.corrected, options.modules, &json, &summary);
  summary.report += AddDiagnosedSamples(robot, diagnosis, options.source,
                                        FormatsBesideUrdf(options.exports),
                                        &json, &summary.files);
  summary.brief = BriefReport(diagnosis);
  if (changes) AddChanges(*changes, &json, &summary);
  if (sensor) {
    json["force_torque_sensor"] = ForceTorqueJson(*sensor, logs);
    summary.report += ForceTorqueText(*sensor);
  }
  summary.json = json.dump(2) + "\n";
  summary.files.push_back({"diagnosis.json", summary.json});
  summary.files.push_back({"robot.urdf", corrected.urdf});
  summary.files.push_back({"effects.json", corrected.effects.dump(2) + "\n"});
  summary.positive = diagnosis.verdict != GapVerdict::kNotTestable;
  summary.verdict = GapVerdictName(diagnosis.verdict);
  for (const FoundEffect& found : diagnosis.effects) {
    summary.effects.push_back(
        {found.effect->name,
         found.joint < 0 ? "" : robot.links[found.joint].joint.name,
         found.probability, found.removed_percent});
  }
  summary.robot = diagnosis.corrected.plant.robot;
  return summary;
}

// What a page or another program asks of it beside the words.
void KeepDetails(const LogSet& held_out, const LogInput& calibrations_own,
                 const DiagnoseOptions& options,
                 std::shared_ptr<GapDiagnosis> details,
                 DiagnoseSummary* summary) {
  if (options.draw_torques) {
    summary->torques = std::make_shared<DrawnTorques>(Draw(*details, held_out));
  }
  summary->details = std::move(details);
  for (const LogSource& log : calibrations_own.logs) {
    summary->calibration_logs.push_back(log.path());
  }
}

// The logs of a diagnosis; null: there are none of these.
struct DiagnosedLogs {
  const LogSet& training;
  const LogSet* held_out;
  const LogSet* reference;
  const LogSet* calibrations_own;
};

// A calibration's own logs are asked what is new, `trust_beside_own` being that
// in the file's numbers then; else a reference is, if there is one.
std::shared_ptr<GapDiagnosis> DiagnosedGap(const Robot& robot,
                                           const DiagnosisOptions& options,
                                           double trust_beside_own,
                                           const DiagnosedLogs& logs) {
  const LogSet* own = logs.calibrations_own;
  auto diagnosis = std::make_shared<GapDiagnosis>(
      own != nullptr
          ? DiagnoseSinceCalibration(robot, options, trust_beside_own,
                                     logs.training, logs.held_out, *own)
          : DiagnoseGap(robot, options, logs.training, logs.held_out,
                        logs.reference));
  if (diagnosis->has_reference) {
    diagnosis->reference_logs = (own != nullptr ? own : logs.reference)->size();
  }
  return diagnosis;
}

}  // namespace

DiagnoseSummary Diagnose(const Robot& robot, const LogInput& logs,
                         const DiagnoseOptions& options) {
  CheckApart(logs, options.validation);
  FormatsNamed(options.exports);  // refused before anything is calculated
  LogReaderOptions reading = options.reading;
  reading.joint_names = robot.JointNames();
  reading.want_temperature = reading.want_wrench = true;
  if (options.progress) options.progress("opening the logs", -1);
  DiagnosisOptions fit = FitOptions(options);
  const std::optional<CalibratedRobot> calibrated =
      ReadDiagnosedCalibration(robot, options.calibration, &fit.baseline);
  std::vector<LogSource> all = AllLogs(logs, options);
  const CalibrationLogs own = LogsBeside(calibrated, all, reading, options);
  all.insert(all.end(), own.input.logs.begin(), own.input.logs.end());
  const MendedLogs mended = MendLogs(
      robot,
      UsedParts({&logs, &options.validation, &options.reference, &own.input}),
      all, options, &reading);
  if (AreLawsInDoubt(mended.clocks)) LeaveOutLaws(&fit);
  // They are looked for while effects are, and needed when these are judged.
  std::vector<DataFinding> wrong_readings;
  tbb::task_group looking;
  if (options.controller.empty()) {
    const bool scales =
        options.reference.logs.empty() && options.calibration.empty();
    looking.run([&, scales] {
      wrong_readings = WrongReadings(robot, all, reading, scales);
    });
    fit.wrong_readings = [&] {
      looking.wait();
      return wrong_readings;
    };
  }
  const LogSet training(logs.logs, reading, logs.crop);
  const std::optional<LogSet> reference = Open(options.reference, reading);
  const std::optional<LogSet> validation = Open(options.validation, reading);
  SetController(robot, validation ? options.validation : logs, options, reading,
                &fit);
  const LogSet* held_out = validation ? &*validation : nullptr;
  const LogSet* before = reference ? &*reference : nullptr;
  CheckTimeUnits({&training, before, held_out});
  const Robot& known = calibrated ? calibrated->robot : robot;
  const std::optional<LogSet> beside = Open(own.input, reading);
  std::shared_ptr<GapDiagnosis> details =
      DiagnosedGap(known, fit, TrustInFile(options, true),
                   {training, held_out, before, beside ? &*beside : nullptr});
  if (fit.may_trust_less) NoteTrust(fit.baseline.trust, details.get());
  details->data.insert(details->data.begin(), mended.rows.begin(),
                       mended.rows.end());
  AddClocks(mended.clocks, logs.logs, options, details.get());
  if (calibrated) {
    NoteCalibration(*calibrated, own, {&training, held_out, before},
                    details.get());
  }
  const std::optional<LogChanges> changes =
      ChangesOf(robot, logs, reading, options);
  // They hold what is told of friction and offsets in fewer logs.
  if (changes && changes->refusal.empty()) details->drifts.clear();
  const std::optional<ForceTorqueChange> sensor = ForceTorqueChangeOf(
      known, details->bandwidth_hz, options.progress, training, before);
  DiagnoseSummary summary =
      Summarise(robot, options, changes, sensor, NamesOf(logs.logs), *details);
  KeepDetails(validation ? *validation : training, own.input, options,
              std::move(details), &summary);
  return summary;
}

}  // namespace armcal
