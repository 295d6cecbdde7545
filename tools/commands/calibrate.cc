#include "tools/commands/calibrate.h"

#include <gflags/gflags.h>

#include <cmath>

#include "calib/drive_gains/report.h"
#include "calib/excite/motion_advice.h"
#include "calib/excite/segment_selection.h"
#include "calib/linear/calibrate_linear.h"
#include "calib/linear/calibration.h"
#include "calib/linear/calibration_model.h"
#include "calib/linear/calibration_report.h"
#include "calib/linear/outlier_report.h"
#include "calib/linear/verdict.h"
#include "model/text/input_text.h"
#include "tools/commands/calibrate_commanded.h"
#include "tools/commands/calibrate_flags.h"
#include "tools/commands/calibrate_payload.h"
#include "tools/commands/calibrate_poses.h"
#include "tools/commands/calibrate_refined.h"
#include "tools/commands/calibrate_report.h"
#include "tools/commands/correct_trajectories.h"
#include "tools/input_flags.h"
#include "tools/output_folder.h"
#include "tools/report/report_data.h"

DEFINE_bool(select, false,
            "calibrate on the segments of the logs that tell most, as few as "
            "tell nearly all");
DEFINE_double(segment, 5, "`S` length of segments for --select");

namespace armcal {
namespace {

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
  task.linear = LinearOptionsFromFlags(input.flags, task.robot);
  task.linear.progress = input.progress;
  CheckTrajectoryFlag(input.flags, task.linear);
  task.refinement = RefinementFromFlags(input.flags, task.robot, task.linear);
  if (task.refinement) task.refinement->options.progress = input.progress;
  task.logs = LogOptionsFromFlags(input.flags, task.robot);
  CheckLogsApart(input);
  return task;
}

// Adds the robot for simulators to the outputs. False where one was asked for
// and there is none.
bool Refine(const CommandInput& input, const Task& task,
            const LinearCalibration& linear, const LogSet& training,
            const LogSet* held_out,
            std::optional<NonlinearCalibration>* refined, nlohmann::json* json,
            CommandOutcome* outcome) {
  if (!task.refinement || !linear.solved) return true;
  const Refinement& refinement = *task.refinement;
  if (!refinement.why_not.empty()) {
    outcome->output.text += "no robot file: " + refinement.why_not + "\n";
    return !refinement.asked_for;
  }
  *refined = CalibrateNonlinear(
      task.robot, linear, refinement.options, training, held_out,
      refinement.poses ? &*refinement.poses : nullptr);
  AddRefinedOutputs(input, task.robot, **refined, json, outcome);
  if ((*refined)->solved) {
    outcome->model = std::make_shared<TracedModel>(
        TraceRobot("calibrated", (*refined)->robot, linear.transitions));
  }
  return (*refined)->converged() || !refinement.asked_for;
}

// With --select the segments to calibrate on take the place of all logs.
std::optional<SegmentSelection> SelectFromFlags(const FlagValues& flags,
                                                const Task& task,
                                                const LogSet& training) {
  constexpr double kMostRatio = 1.25;  // of standard deviations
  if (!flags.Switch("select")) return {};
  if (task.linear.identification != Identification::kWeak) {
    throw UsageError(
        "--select: expected --identification=weak with it, whose noise tells "
        "what segments are worth");
  }
  const double segment = flags.Number("segment");
  if (!(segment >= 1) || !std::isfinite(segment)) {
    throw UsageError("--segment: found '" + NumberText(segment) +
                     "', expected a length of at least 1 s");
  }
  const LinearCalibration all =
      CalibrateLinear(task.robot, task.linear, training, nullptr);
  if (!all.solved) return {};
  return SelectSegments(task.robot, all, task.linear, segment, kMostRatio,
                        training);
}

CommandOutcome RunCalibrate(const CommandInput& input) {
  if (PosesAloneFromFlags(input.flags)) return CalibratePosesFromFlags(input);
  if (CommandedFromFlags(input.flags))
    return CalibrateCommandedFromFlags(input);
  Task task = TaskFromFlags(input);
  const Robot& robot = task.robot;
  input.Begin("opening the logs");
  const auto gains = DriveGainsFromFlags(input, robot, task.linear, &task.logs);
  if (gains && !gains->solved) return UnsolvedGains(input, robot, *gains);
  LogSet training(SourcesOf(input, LogsFromFlags(input)), task.logs,
                  CropFromFlags(input.flags));
  const LogSet validation(SourcesOf(input, ValidationLogsFromFlags(input)),
                          task.logs, ValidationCropFromFlags(input.flags));
  const LogSet* const held_out = validation.size() > 0 ? &validation : nullptr;

  const std::optional<SegmentSelection> selection =
      SelectFromFlags(input.flags, task, training);
  CommandOutcome outcome;
  std::string& report = outcome.output.text;
  if (gains) report = DriveGainsReport(*gains);
  if (selection) {
    report += SelectionText(*selection, training);
    training = training.Within(selection->Stretches(training));
  }
  LinearCalibration result =
      CalibrateLinear(robot, task.linear, training, held_out);
  result.identifiability.advice =
      AdviseMotions(robot, result, task.linear, training);
  const std::string corrected = CorrectTrajectories(
      input.flags, robot, task.linear, training, held_out, &result);
  if (result.solved) {
    outcome.model = std::make_shared<TracedModel>(
        TracedModel{"calibrated", result.parameters, result.x});
  }
  outcome.brief = BriefReport(robot, result);
  nlohmann::json json = ToJson(robot, training, held_out, result);
  report += FullReport(robot, training, result) + corrected;
  if (gains) AddDriveGains(*gains, &json);
  if (selection) json["selection"] = ToJson(*selection, training);
  OutputFolder& out = outcome.folders.emplace_back(OutFromFlags(input.flags));
  std::optional<NonlinearCalibration> arm;
  const bool refined =
      Refine(input, task, result, training, held_out, &arm, &json, &outcome);
  outcome.output.json = json.dump(2) + "\n";
  out.Add("calibration.json", outcome.output.json);
  out.Add("covariance.csv", CovarianceCsv(result));
  out.Add("outliers.csv", OutlierCsv(robot, training, result));
  AddCalibrationReport(
      input, robot, outcome.output.json,
      {result, arm ? &*arm : nullptr,
       held_out != nullptr ? Prepare(*held_out, PreparationForRows(result.rows))
                           : Prepare(training, result.preparation)},
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
       {"commanded logs",
        {"controller", "gains_trust", "delay_trust", "torque_log"},
        false},
       {"equations and solver",
        {"identification", "solver", "loss", "trajectory", "joint_terms",
         "coulomb_width", "window", "interval", "intervals", "quadrature"},
        false},
       {"payload", {"payload_mass", "payload_log"}, false},
       {"trust in geometry", {"length_trust", "angle_trust"}, false},
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
