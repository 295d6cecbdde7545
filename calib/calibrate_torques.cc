#include <algorithm>
#include <cmath>
#include <utility>

#include "calib/calibrate_parts.h"
#include "calib/calibrated_robot.h"
#include "calib/calibration_details.h"
#include "calib/drive_gains/estimate_drive_gains.h"
#include "calib/drive_gains/report.h"
#include "calib/drive_trains/drive_train.h"
#include "calib/drive_trains/report.h"
#include "calib/excite/motion_advice.h"
#include "calib/excite/segment_selection.h"
#include "calib/force_torque/report.h"
#include "calib/force_torque/sensor.h"
#include "calib/linear/calibrate_linear.h"
#include "calib/linear/calibration_model.h"
#include "calib/linear/calibration_report.h"
#include "calib/linear/outlier_report.h"
#include "calib/linear/verdict.h"
#include "calib/log_doubts.h"
#include "calib/log_readings.h"
#include "calib/poses/reading_audit.h"
#include "calib/refine/far_masses.h"
#include "calib/refine/impossible_robot.h"
#include "calib/refine/nonlinear_report.h"
#include "calib/refine/trajectory_refinement.h"
#include "calib/robot_outputs.h"
#include "model/text/format.h"
#include "model/text/input_text.h"
#include "model/text/option_error.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

// OptionError unless an option has a value that `fits`.
void Expect(bool fits, const std::string& name, const std::string& value,
            const std::string& expected) {
  if (fits) return;
  throw OptionError(OptionName(name) + ": found '" + value + "', expected " +
                    expected);
}

void CheckTrajectories(const CalibrateOptions& options) {
  if (!options.correct_trajectories) return;
  const LinearCalibrationOptions& e = options.equations;
  const auto expect = [](bool fits, const std::string& name,
                         const std::string& value) {
    Expect(fits, "trajectory", "corrected",
           OptionName(name) + "=" + value + " with it");
  };
  expect(e.identification == Identification::kWeak, "identification", "weak");
  expect(e.solver == LinearSolver::kWeighted, "solver", "weighted");
  const RobustLoss loss = e.loss.value_or(RobustLoss::kHuber);
  expect(loss == RobustLoss::kHuber || loss == RobustLoss::kSquared, "loss",
         "huber or squared");
  expect(options.target != CalibrationTarget::kRefined, "estimate",
         "linear or auto");
}

void CheckSelection(const CalibrateOptions& options) {
  if (!options.select_s) return;
  if (options.equations.identification != Identification::kWeak) {
    throw OptionError(OptionName("select") + ": expected " +
                      OptionName("identification") +
                      "=weak with it, whose noise tells what segments are "
                      "worth");
  }
  Expect(*options.select_s >= 1 && std::isfinite(*options.select_s), "segment",
         NumberText(*options.select_s), "a length of at least 1 s");
}

void CheckPayload(const CalibrateOptions& options, const LogInput& logs) {
  const std::string log = OptionName("payload_log");
  const std::string twice =
      NamedBefore(logs, options.validation, options.payload->logs);
  if (!twice.empty()) {
    throw OptionError(log + " names " + twice +
                      ", which is named before; logs of the bare arm (" +
                      OptionName("log") + ", " + OptionName("validate") +
                      ") and with the payload are different ones");
  }
  const LogReaderOptions& reading = options.reading;
  if (!reading.torque_constants.empty()) {
    throw OptionError(OptionName("torque_constants") + " is what " + log +
                      " estimates; give one of them");
  }
  if (reading.torque_kind != TorqueKind::kAuto &&
      reading.torque_kind != TorqueKind::kCurrent) {
    throw OptionError(log +
                      " estimates torque constants from currents; expected " +
                      OptionName("torque_kind") + "=current");
  }
  if (options.equations.geometry != GeometryKnowledge::kKnown) {
    throw OptionError(log + " takes " + OptionName("geometry") + "=known");
  }
}

bool RefinesGeometry(const CalibrateOptions& options) {
  return options.geometry != RefineGeometry::kNothing || options.poses;
}

// Beside what is written anyway.
bool WantsRobot(const CalibrateOptions& options) {
  return !options.exports.empty() || options.samples > 0;
}

void CheckTarget(const CalibrateOptions& options) {
  FormatsNamed(options.exports);  // refused before anything is calculated
  Expect(options.target != CalibrationTarget::kLinear || !WantsRobot(options),
         "estimate", "linear",
         "refined or auto with " + OptionName("export") +
             ": model parameters alone are no robot to write");
  Expect(
      options.target != CalibrationTarget::kLinear || !RefinesGeometry(options),
      "estimate", "linear",
      "refined or auto: a geometry is only refined together with the "
      "robot");
}

std::string WhyNotRefined(const Robot& robot,
                          const LinearCalibrationOptions& options) {
  if (options.identification != Identification::kWeak) {
    return "it takes the weak form";
  }
  for (const Link& link : robot.links) {
    // A link between two joints of one body is held at no mass (ArmUnknowns).
    if (link.inertial.mass > 0 || IsDeclaredMassless(link)) continue;
    return "the robot file gives link " + link.name + " no mass to start from";
  }
  return "";
}

class TorqueCalibrator {
 public:
  TorqueCalibrator(const Robot& robot, const LogInput& logs,
                   const CalibrateOptions& options)
      : robot_(robot), input_(logs), options_(options) {
    CheckTrajectories(options_);
    CheckTarget(options_);
    CheckApart(logs, options.validation);
    CheckSelection(options_);
    if (options_.poses) RequireReading(robot_, *options_.poses, "poses");
  }

  CalibrateSummary Run();

 private:
  // What is wrong with positions is not read.
  void Mend();
  // The torque constants become the reading's; false where they are not known,
  // which the summary tells.
  bool EstimateGains();
  void Select();
  void CorrectTrajectories();
  // False where a robot was asked for and there is none.
  bool Refine(nlohmann::json* json);
  // What the sensor carries, where logs have its columns.
  void AddForceTorque(nlohmann::json* json);
  void AddDriveTrains(nlohmann::json* json);
  // False where no robot that can exist explains the logs, which the verdict
  // tells before all else.
  bool IsPossible(nlohmann::json* json);
  // Before the report, where masses are far from the file's.
  void WarnOfMasses(nlohmann::json* json);
  void Draw();

  const LinearCalibration& linear() const { return *details_->linear; }
  const LogSet* held_out() const { return held_out_ ? &*held_out_ : nullptr; }

  const Robot& robot_;
  const LogInput& input_;
  CalibrateOptions options_;
  std::vector<DataFinding> mended_;
  std::optional<DriveGains> gains_;
  std::optional<LogSet> training_, held_out_;
  std::optional<SegmentSelection> selection_;
  std::shared_ptr<CalibrationDetails> details_ =
      std::make_shared<CalibrationDetails>();
  CalibrateSummary summary_;
};

void TorqueCalibrator::Mend() {
  LogInput payload;
  if (options_.payload) payload.logs = options_.payload->logs;
  mended_ = MendPositions(robot_,
                          UsedParts({&input_, &options_.validation, &payload}),
                          &options_.reading);
}

bool TorqueCalibrator::EstimateGains() {
  if (!options_.payload) return true;
  CheckPayload(options_, input_);
  LogReaderOptions& reading = options_.reading;
  reading.efforts_are_torques = reading.torque_kind == TorqueKind::kAuto;
  reading.torque_kind = TorqueKind::kCurrent;
  reading.torque_constants.assign(robot_.num_joints(), 1);
  LogReaderOptions currents = reading;
  currents.torque_constants_stddev = 0;
  const LogSet bare(input_.logs, currents, input_.crop);
  const LogSet payload(options_.payload->logs, currents, TimeRange());
  gains_ = EstimateDriveGains(robot_, options_.equations,
                              options_.payload->mass, bare, &payload);
  summary_.report = DriveGainsReport(*gains_, reading.torque_constants_stddev);
  if (gains_->solved) {
    reading.torque_constants = gains_->TorqueConstants();
    if (!reading.torque_constants_stddev) {
      reading.torque_constants_stddev = gains_->LargestRelativeStddev();
    }
    return true;
  }
  nlohmann::json json = {{"format", "armcal calibration 1"},
                         {"robot", robot_.name}};
  AddDriveGains(*gains_, &json);
  summary_.json = json.dump(2) + "\n";
  // No older matrix beside a refusal.
  summary_.files = {{"calibration.json", summary_.json},
                    {"covariance.csv", "\n"}};
  summary_.positive = false;
  return false;
}

// The segments to calibrate on take the place of all logs.
void TorqueCalibrator::Select() {
  constexpr double kMostRatio = 1.25;  // of standard deviations
  if (!options_.select_s) return;
  const LinearCalibration all =
      CalibrateLinear(robot_, options_.equations, *training_, nullptr);
  if (!all.solved) return;
  selection_ = SelectSegments(robot_, all, options_.equations,
                              *options_.select_s, kMostRatio, *training_);
  summary_.report += SelectionText(*selection_, *training_);
  training_ = training_->Within(selection_->Stretches(*training_));
}

void TorqueCalibrator::CorrectTrajectories() {
  if (!options_.correct_trajectories || !linear().solved) return;
  const TrajectoryRefinement refinement = RefineTrajectories(
      robot_, options_.equations, linear(), *training_, held_out());
  details_->linear = refinement.calibration;
  if (!refinement.refined) {
    summary_.report +=
        "trajectories not corrected: " + refinement.reason + "\n";
    return;
  }
  summary_.report += Format(
      "trajectories corrected (splines with knots every %.0f ms; %s)\n"
      "encoder noise  ",
      1e3 * refinement.knot_s, refinement.reason.c_str());
  for (const double noise : linear().encoder_noise) {
    summary_.report += Format(" %.2g", noise);
  }
  summary_.report += " rad (m)\n";
}

bool TorqueCalibrator::Refine(nlohmann::json* json) {
  if (options_.target == CalibrationTarget::kLinear || !linear().solved) {
    return true;
  }
  const bool asked_for = options_.target == CalibrationTarget::kRefined ||
                         RefinesGeometry(options_) || WantsRobot(options_);
  const std::string why_not = WhyNotRefined(robot_, options_.equations);
  if (!why_not.empty()) {
    summary_.report += "no robot file: " + why_not + "\n";
    return !asked_for;
  }
  NonlinearCalibrationOptions fit;
  fit.trust = options_.trust;
  fit.refine = options_.geometry;
  fit.pose_loss = options_.equations.loss.value_or(fit.pose_loss);
  fit.progress = options_.progress;
  const NonlinearCalibration& refined = details_->refined.emplace(
      CalibrateNonlinear(robot_, linear(), fit, *training_, held_out(),
                         options_.poses ? &*options_.poses : nullptr));
  AddRefined(refined, json);
  summary_.report += NonlinearReport(robot_, refined);
  if (refined.solved) {
    AddCalibratedRobot(refined, {}, options_, json, &summary_);
    SetParameters(refined, &summary_);
    details_->model =
        TraceRobot("calibrated", refined.robot, linear().transitions);
  }
  return refined.converged() || !asked_for;
}

void TorqueCalibrator::AddDriveTrains(nlohmann::json* json) {
  if (!linear().solved || !training_->has_current()) return;
  const DriveTrains drives = EstimateDriveTrains(
      robot_, options_.progress, Prepare(*training_, linear().preparation));
  if (drives.samples == 0) return;
  (*json)["drive_trains"] = DriveTrainsJson(drives);
  summary_.report += DriveTrainsText(drives);
}

void TorqueCalibrator::AddForceTorque(nlohmann::json* json) {
  if (!linear().solved || !training_->has_wrench()) return;
  const ForceTorqueSensor sensor = EstimateForceTorqueSensor(
      robot_, options_.progress, Prepare(*training_, linear().preparation));
  if (sensor.samples == 0) return;
  (*json)["force_torque_sensor"] = ForceTorqueJson(sensor);
  summary_.report += ForceTorqueText(sensor);
}

bool TorqueCalibrator::IsPossible(nlohmann::json* json) {
  if (!details_->refined) return true;
  const std::string why_not =
      WhatNoRobotExplains(linear(), *details_->refined, options_.trust);
  if (why_not.empty()) return true;
  std::vector<std::string> reasons = Shortcomings(robot_, linear());
  reasons.insert(reasons.begin(), why_not);
  (*json)["verdict"] = VerdictJson(reasons);
  summary_.report = VerdictText({why_not}) + summary_.report;
  summary_.brief = why_not + " " + summary_.brief;
  return false;
}

void TorqueCalibrator::WarnOfMasses(nlohmann::json* json) {
  if (!details_->refined) return;
  const std::string far = WhatMassesAreFar(*details_->refined);
  if (far.empty()) return;
  (*json)["warnings"].push_back(far);
  summary_.report = "warning    " + far + "\n" + summary_.report;
  summary_.brief = far + " " + summary_.brief;
}

// Of what is held out, where there is something.
void TorqueCalibrator::Draw() {
  if (!options_.draw_torques || !linear().solved) return;
  std::vector<TracedModel> models;
  const bool massive =
      std::any_of(robot_.links.begin(), robot_.links.end(),
                  [](const Link& link) { return link.inertial.mass > 0; });
  if (massive) models.push_back(TraceRobot("the robot file", robot_, {}));
  models.push_back({"calibrated", linear().parameters, linear().x});
  if (details_->refined && details_->refined->solved) {
    models.push_back(TraceRobot("calibrated, for a simulator",
                                details_->refined->robot,
                                linear().transitions));
  }
  const PreparedLogs logs =
      held_out_ ? Prepare(*held_out_, PreparationForRows(linear().rows))
                : Prepare(*training_, linear().preparation);
  details_->torques = DrawTorques(models, options_.progress, logs);
}

CalibrateSummary TorqueCalibrator::Run() {
  if (options_.progress) options_.progress("opening the logs", -1);
  Mend();
  if (!EstimateGains()) return summary_;
  LogReaderOptions with_sensor = options_.reading;
  with_sensor.want_wrench = with_sensor.want_current = true;
  training_.emplace(input_.logs, with_sensor, input_.crop);
  const LogInput& validation = options_.validation;
  if (!validation.logs.empty()) {
    held_out_.emplace(validation.logs, options_.reading, validation.crop);
  }
  Select();
  details_->linear =
      CalibrateLinear(robot_, options_.equations, *training_, held_out());
  details_->linear->identifiability.advice =
      AdviseMotions(robot_, linear(), options_.equations, *training_);
  const std::string before = std::exchange(summary_.report, "");
  CorrectTrajectories();
  summary_.solved = linear().solved;
  summary_.report =
      before + FullReport(robot_, *training_, linear()) + summary_.report;
  summary_.brief = BriefReport(robot_, linear());
  if (linear().solved) {
    details_->model =
        TracedModel{"calibrated", linear().parameters, linear().x};
  }
  const auto& names = linear().parameters.parameters();
  for (int k = 0; k < linear().x.size(); ++k) {
    summary_.parameters.push_back(
        {names[k].name, names[k].unit, linear().x[k], linear().stddev[k]});
  }
  summary_.covariance = linear().covariance;
  nlohmann::json json = ToJson(robot_, *training_, held_out(), linear());
  if (gains_) AddDriveGains(*gains_, &json);
  if (selection_) json["selection"] = ToJson(*selection_, *training_);
  const bool refined = Refine(&json);
  AddForceTorque(&json);
  AddDriveTrains(&json);
  WarnOfMasses(&json);
  const bool possible = IsPossible(&json);
  AddLogDoubts(robot_, input_, options_, mended_, *training_, *details_, &json,
               &summary_);
  summary_.json = json.dump(2) + "\n";
  summary_.files.push_back({"calibration.json", summary_.json});
  summary_.files.push_back({"covariance.csv", CovarianceCsv(linear())});
  summary_.files.push_back(
      {"outliers.csv", OutlierCsv(robot_, *training_, linear())});
  Draw();
  summary_.positive =
      refined && possible && Shortcomings(robot_, linear()).empty();
  summary_.details = details_;
  return summary_;
}

}  // namespace

CalibrateSummary CalibrateFromTorques(const Robot& robot, const LogInput& logs,
                                      const CalibrateOptions& options) {
  return TorqueCalibrator(robot, logs, options).Run();
}

}  // namespace armcal
