#include "tools/calibrate.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>

#include "calib/calibration_report.h"
#include "calib/drive_gains_report.h"
#include "calib/linear_calibration.h"
#include "calib/motion_advice.h"
#include "calib/outlier_report.h"
#include "calib/segment_selection.h"
#include "calib/verdict.h"
#include "model/input_text.h"
#include "tools/calibrate_payload.h"
#include "tools/calibrate_poses.h"
#include "tools/calibrate_refined.h"
#include "tools/calibrate_report.h"
#include "tools/correct_trajectories.h"
#include "tools/flag_choices.h"
#include "tools/input_flags.h"
#include "tools/output_folder.h"
#include "tools/report/report_data.h"

DEFINE_string(
    geometry, "known",
    "known; lengths (between the joint axes: those the robot file declares "
    "unknown, or all that are not zero, are estimated), all_lengths; offsets "
    "(joint zeros are refined), refine (all of the file's geometry is)");
DEFINE_string(identification, "weak",
              "weak (test functions, no acceleration), differential (2.19), "
              "integral (2.27)");
DEFINE_string(solver, "weighted",
              "weighted (noise of every joint re-estimated), batch (2.25), "
              "recursive (2.28)");
DEFINE_string(joint_terms, "viscous,coulomb,offset,armature",
              "what joints add to the rigid arm, or none");
DEFINE_string(coulomb_width, "auto",
              "how Coulomb friction changes sign: auto (fitted per joint), a "
              "speed such as 0.02rad/s, or a displacement such as 0.001rad, "
              "for all joints");
DEFINE_string(window, "",
              "`S` length of the weak form's test functions, s; default: 1.5 "
              "periods of the bandwidth, at least 0.3");
DEFINE_string(
    intervals, "",
    "`T1:T2[,..]` integral model: from T1 to T2, s; default: side by side");
DEFINE_double(interval, 0.5, "`S` integral model: length of intervals");
DEFINE_bool(select, false,
            "calibrate on the segments of the logs that tell most, as few as "
            "tell nearly all");
DEFINE_double(segment, 5, "`S` length of segments for --select");
DEFINE_string(quadrature, "trapezoid", "integral model: trapezoid, simpson");

namespace armcal {
namespace {

const FlagChoices<GeometryKnowledge> kGeometries(
    "geometry", {{"known", GeometryKnowledge::kKnown},
                 {"lengths", GeometryKnowledge::kNonzeroLengths},
                 {"all_lengths", GeometryKnowledge::kAllLengths},
                 {"offsets", GeometryKnowledge::kKnown},
                 {"refine", GeometryKnowledge::kKnown}});
const FlagChoices<JointTerm> kJointTerms("joint_terms",
                                         {{"viscous", JointTerm::kViscous},
                                          {"coulomb", JointTerm::kCoulomb},
                                          {"offset", JointTerm::kOffset},
                                          {"armature", JointTerm::kArmature}},
                                         true);
const FlagChoices<Identification> kIdentifications(
    "identification", {{"weak", Identification::kWeak},
                       {"differential", Identification::kDifferential},
                       {"integral", Identification::kIntegral}});
const FlagChoices<LinearSolver> kSolvers("solver",
                                         {{"weighted", LinearSolver::kWeighted},
                                          {"batch", LinearSolver::kBatch},
                                          {"recursive",
                                           LinearSolver::kRecursive}});
const FlagChoices<Quadrature> kQuadratures(
    "quadrature",
    {{"trapezoid", Quadrature::kTrapezoid}, {"simpson", Quadrature::kSimpson}});

GeometryKnowledge GeometryFromFlags(const Robot& robot) {
  const GeometryKnowledge knowledge = kGeometries.Parse(FLAGS_geometry);
  if (knowledge != GeometryKnowledge::kNonzeroLengths) return knowledge;
  for (const Link& link : robot.links) {
    if (!link.unknown_lengths.empty()) {
      return GeometryKnowledge::kDeclaredLengths;
    }
  }
  return GeometryKnowledge::kNonzeroLengths;
}

std::vector<JointTerm> JointTermsFromFlags() {
  std::vector<JointTerm> terms;
  if (FLAGS_joint_terms == "none") return terms;
  for (const std::string& name : SplitAtCommas(FLAGS_joint_terms)) {
    const JointTerm term = kJointTerms.Parse(name);
    if (std::count(terms.begin(), terms.end(), term) > 0) {
      throw UsageError("--joint_terms: found '" + FLAGS_joint_terms +
                       "', expected " + name + " only once");
    }
    terms.push_back(term);
  }
  return terms;
}

std::optional<CoulombTransition> TransitionFromFlags() {
  using Law = CoulombTransition::Law;
  const std::string& text = FLAGS_coulomb_width;
  if (text == "auto") return std::nullopt;
  for (const auto& [unit, law] :
       std::vector<std::pair<std::string, Law>>{{"rad/s", Law::kVelocity},
                                                {"m/s", Law::kVelocity},
                                                {"rad", Law::kDisplacement},
                                                {"m", Law::kDisplacement}}) {
    const size_t at = text.rfind(unit);
    if (at == std::string::npos || at + unit.size() != text.size()) continue;
    return CoulombTransition{
        law, PositiveNumber("coulomb_width", text.substr(0, at))};
  }
  throw UsageError("--coulomb_width: found '" + text +
                   "', expected auto, a speed (0.02rad/s) or a displacement "
                   "(0.001rad)");
}

LinearCalibrationOptions OptionsFromFlags(const Robot& robot) {
  LinearCalibrationOptions options;
  options.geometry = GeometryFromFlags(robot);
  options.joint_terms = JointTermsFromFlags();
  options.transition = TransitionFromFlags();
  options.identification = kIdentifications.Parse(FLAGS_identification);
  options.solver = kSolvers.Parse(FLAGS_solver);
  options.loss = LossFromFlags();
  options.quadrature = kQuadratures.Parse(FLAGS_quadrature);
  if (!FLAGS_window.empty()) {
    options.window_s = PositiveNumber("window", FLAGS_window);
  }
  options.intervals = ParseRanges("intervals", FLAGS_intervals);
  for (const TimeRange& range : options.intervals) {
    if (!std::isfinite(range.begin) || !std::isfinite(range.end)) {
      throw UsageError("--intervals: found '" + FLAGS_intervals +
                       "', expected t1:t2 with both ends");
    }
  }
  if (!(FLAGS_interval > 0) || !std::isfinite(FLAGS_interval)) {
    throw UsageError("--interval: found '" + NumberText(FLAGS_interval) +
                     "', expected a length in s above 0");
  }
  options.interval_s = FLAGS_interval;
  options.bandwidth_hz = BandwidthFromFlags();
  return options;
}

// What was measured and what is asked for.
struct Task {
  Robot robot;
  LinearCalibrationOptions linear;
  std::optional<Refinement> refinement;
  LogReaderOptions logs;
};

Task TaskFromFlags(const CommandInput& input) {
  Task task;
  task.robot = RobotFromFlags(input);
  task.linear = OptionsFromFlags(task.robot);
  task.linear.progress = input.progress;
  CheckTrajectoryFlag(task.linear);
  task.refinement = RefinementFromFlags(task.robot, task.linear);
  if (task.refinement) task.refinement->options.progress = input.progress;
  task.logs = LogOptionsFromFlags(task.robot);
  CheckLogsApart();
  return task;
}

// Adds the robot for simulators to the outputs. False where one was asked for
// and there is none.
bool Refine(const Task& task, const LinearCalibration& linear, LogSet* training,
            LogSet* held_out, std::optional<NonlinearCalibration>* refined,
            nlohmann::json* json, CommandOutcome* outcome) {
  if (!task.refinement || !linear.solved) return true;
  const Refinement& refinement = *task.refinement;
  if (!refinement.why_not.empty()) {
    outcome->output.text += "no robot file: " + refinement.why_not + "\n";
    return !refinement.asked_for;
  }
  *refined = CalibrateNonlinear(
      task.robot, linear, refinement.options, training, held_out,
      refinement.poses ? &*refinement.poses : nullptr);
  AddRefinedOutputs(task.robot, **refined, json, outcome);
  if ((*refined)->solved) {
    outcome->model = std::make_shared<TracedModel>(
        TraceRobot("calibrated", (*refined)->robot, linear.transitions));
  }
  return (*refined)->converged() || !refinement.asked_for;
}

// With --select the segments to calibrate on take the place of all logs.
std::optional<SegmentSelection> SelectFromFlags(const Task& task,
                                                LogSet* training) {
  constexpr double kMostRatio = 1.25;  // of standard deviations
  if (!FLAGS_select) return {};
  if (!(FLAGS_segment >= 1) || !std::isfinite(FLAGS_segment)) {
    throw UsageError("--segment: found '" + NumberText(FLAGS_segment) +
                     "', expected a length of at least 1 s");
  }
  const LinearCalibration all =
      CalibrateLinear(task.robot, task.linear, training, nullptr);
  if (!all.solved) return {};
  return SelectSegments(task.robot, all, task.linear, FLAGS_segment, kMostRatio,
                        training);
}

CommandOutcome RunCalibrate(const CommandInput& input) {
  if (PosesAloneFromFlags()) return CalibratePosesFromFlags(input);
  Task task = TaskFromFlags(input);
  const Robot& robot = task.robot;
  input.Begin("opening the logs");
  const auto gains = DriveGainsFromFlags(robot, task.linear, &task.logs);
  if (gains && !gains->solved) return UnsolvedGains(robot, *gains);
  LogSet training(LogsFromFlags(), task.logs, CropFromFlags());
  LogSet validation(ValidationLogsFromFlags(), task.logs,
                    ValidationCropFromFlags());
  LogSet* const held_out = validation.size() > 0 ? &validation : nullptr;

  const std::optional<SegmentSelection> selection =
      SelectFromFlags(task, &training);
  CommandOutcome outcome;
  std::string& report = outcome.output.text;
  if (gains) report = DriveGainsReport(*gains);
  if (selection) {
    report += SelectionText(*selection, training);
    training.Keep(selection->Stretches(training));
  }
  LinearCalibration result =
      CalibrateLinear(robot, task.linear, &training, held_out);
  result.identifiability.advice =
      AdviseMotions(robot, result, task.linear, &training);
  const std::string corrected =
      CorrectTrajectories(robot, task.linear, &training, held_out, &result);
  if (result.solved) {
    outcome.model = std::make_shared<TracedModel>(
        TracedModel{"calibrated", result.parameters, result.x});
  }
  outcome.brief = BriefReport(robot, result);
  nlohmann::json json = ToJson(robot, training, held_out, result);
  report += FullReport(robot, training, result) + corrected;
  if (gains) AddDriveGains(*gains, &json);
  if (selection) json["selection"] = ToJson(*selection, training);
  OutputFolder& out = outcome.folders.emplace_back(OutFromFlags());
  std::optional<NonlinearCalibration> arm;
  const bool refined =
      Refine(task, result, &training, held_out, &arm, &json, &outcome);
  outcome.output.json = json.dump(2) + "\n";
  out.Add("calibration.json", outcome.output.json);
  out.Add("covariance.csv", CovarianceCsv(result));
  out.Add("outliers.csv", OutlierCsv(robot, training));
  AddCalibrationReport(
      robot, json,
      {result, arm ? &*arm : nullptr,
       held_out != nullptr ? held_out : &training, input.progress},
      &out);
  outcome.output.verdict = robot.name + ": ";
  outcome.output.positive = refined && Shortcomings(robot, result).empty();
  outcome.output.notes = robot.notes;
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
       {"payload", {"payload_mass", "payload_log"}, false},
       {"equations and solver",
        {"identification", "solver", "loss", "trajectory", "joint_terms",
         "coulomb_width", "window", "interval", "intervals", "quadrature"},
        false},
       {"trust in geometry", {"length_trust", "angle_trust"}, false},
       {"robot files", {"export"}, false},
       ChainFlags()},
      {"armcal calibrate --robot=arm.urdf --log=mon.csv --validate=tue.csv "
       "--out=made",
       "armcal calibrate --robot=arm.yaml --log=log.csv.gz --geometry=lengths",
       "armcal calibrate --robot=arm.urdf --log=log.csv --json | jq .rank"},
      &RunCalibrate};
}

}  // namespace armcal
