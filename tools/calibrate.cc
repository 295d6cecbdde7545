#include "tools/calibrate.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "calib/calibration_report.h"
#include "calib/drive_gains_report.h"
#include "calib/linear_calibration.h"
#include "calib/nonlinear_calibration.h"
#include "calib/nonlinear_report.h"
#include "calib/outlier_report.h"
#include "calib/verdict.h"
#include "model/input_text.h"
#include "model/urdf_writer.h"
#include "tools/calibrate_payload.h"
#include "tools/calibrate_poses.h"
#include "tools/correct_trajectories.h"
#include "tools/input_flags.h"
#include "tools/output_folder.h"
#include "tools/progress_bar.h"

DECLARE_string(poses);

DEFINE_string(
    geometry, "known",
    "lengths between the joint axes: known; lengths (those the robot "
    "file declares unknown, or all that are not zero, are estimated); "
    "all_lengths; with --poses: known, offsets (joint zeros), refine");
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
              "length of the weak form's test functions, s; default: 1.5 "
              "periods of the bandwidth, at least 0.3");
DEFINE_string(intervals, "",
              "integral model: t1:t2[,t3:t4...], s; default: side by side");
DEFINE_double(interval, 0.5, "integral model: length of intervals, s");
DEFINE_string(quadrature, "trapezoid", "integral model: trapezoid, simpson");
DEFINE_string(estimate, "linear",
              "refined (also a physically consistent robot file for "
              "simulators), linear (model parameters only)");
DEFINE_double(trust, 0.5,
              "relative standard deviation of the robot file's inertial "
              "parameters, which tie what the logs do not show");

namespace armcal {
namespace {

GeometryKnowledge GeometryFromFlags(const Robot& robot) {
  if (FLAGS_geometry != "lengths") {
    return ParseChoice<GeometryKnowledge>(
        "geometry", FLAGS_geometry,
        {{"known", GeometryKnowledge::kKnown},
         {"lengths", GeometryKnowledge::kNonzeroLengths},
         {"all_lengths", GeometryKnowledge::kAllLengths}});
  }
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
    const JointTerm term =
        ParseChoice<JointTerm>("joint_terms", name,
                               {{"viscous", JointTerm::kViscous},
                                {"coulomb", JointTerm::kCoulomb},
                                {"offset", JointTerm::kOffset},
                                {"armature", JointTerm::kArmature}});
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
  options.identification = ParseChoice<Identification>(
      "identification", FLAGS_identification,
      {{"weak", Identification::kWeak},
       {"differential", Identification::kDifferential},
       {"integral", Identification::kIntegral}});
  options.solver =
      ParseChoice<LinearSolver>("solver", FLAGS_solver,
                                {{"weighted", LinearSolver::kWeighted},
                                 {"batch", LinearSolver::kBatch},
                                 {"recursive", LinearSolver::kRecursive}});
  options.loss = LossFromFlags();
  options.quadrature =
      ParseChoice<Quadrature>("quadrature", FLAGS_quadrature,
                              {{"trapezoid", Quadrature::kTrapezoid},
                               {"simpson", Quadrature::kSimpson}});
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

// Whether a robot for simulators is asked for, and how.
bool IsRefinedFromFlags() {
  return ParseChoice<bool>("estimate", FLAGS_estimate,
                           {{"refined", true}, {"linear", false}});
}

double TrustFromFlags() {
  if (FLAGS_trust > 0 && std::isfinite(FLAGS_trust)) return FLAGS_trust;
  throw UsageError("--trust: found '" + NumberText(FLAGS_trust) +
                   "', expected a relative standard deviation above 0");
}

// Why a solved calibration cannot be refined; empty where it can.
std::string WhyNotRefined(const Robot& robot,
                          const LinearCalibrationOptions& options) {
  if (options.identification != Identification::kWeak ||
      options.geometry != GeometryKnowledge::kKnown) {
    return "it takes the weak form and a known geometry";
  }
  for (const Link& link : robot.links) {
    if (link.inertial.mass > 0) continue;
    return "the robot file gives link " + link.name + " no mass to start from";
  }
  return "";
}

void AddRobotFiles(const std::string& robot_path, const Robot& robot,
                   OutputFolder* out) {
  if (robot.dh_convention) {
    out->Add("robot.urdf", MakeUrdf(robot));
    return;
  }
  out->Add("robot.urdf", UpdateUrdf(robot_path, robot, false));
  out->Add("robot_without_meshes.urdf", MakeUrdf(robot));
}

// The report of a refined calibration, the figures and files of which are
// added.
std::string AddRefinedOutputs(const Robot& robot,
                              const NonlinearCalibration& refined,
                              nlohmann::json* json, OutputFolder* out) {
  AddRefined(refined, json);
  std::string report = NonlinearReport(robot, refined);
  if (!refined.solved) return report;
  AddRobotFiles(RobotPathFromFlags(), refined.robot, out);
  out->Add("parameters_covariance.csv", ParametersCovarianceCsv(refined));
  for (const std::string& loss : UrdfLosses(refined.robot)) {
    report += "robot.urdf  " + loss + "\n";
  }
  return report;
}

int RunCalibrate() {
  const Robot robot = RobotFromFlags();
  if (!FLAGS_poses.empty()) return CalibratePosesFromFlags(robot);
  LinearCalibrationOptions options = OptionsFromFlags(robot);
  const bool is_refined = IsRefinedFromFlags();
  NonlinearCalibrationOptions refine;
  refine.trust.inertia = TrustFromFlags();
  CheckTrajectoryFlag(options);
  LogReaderOptions log_options = LogOptionsFromFlags(robot);
  CheckLogsApart();
  ProgressBar bar;
  options.progress = [&bar](const std::string& stage, double fraction) {
    bar.Show(stage, fraction);
  };
  const auto gains = DriveGainsFromFlags(robot, options, &log_options);
  if (gains && !gains->solved) return ReportUnsolvedGains(robot, *gains);
  LogSet training(LogsFromFlags(), log_options, CropFromFlags());
  LogSet validation(ValidationLogsFromFlags(), log_options,
                    ValidationCropFromFlags());
  LogSet* const held_out = validation.size() > 0 ? &validation : nullptr;

  refine.progress = options.progress;
  LinearCalibration result =
      CalibrateLinear(robot, options, &training, held_out);
  const std::string corrected =
      CorrectTrajectories(robot, options, &training, held_out, &result);
  nlohmann::json json = ToJson(robot, training, held_out, result);
  std::string report = gains ? DriveGainsReport(*gains) : "";
  report += FullReport(robot, training, result) + corrected;
  if (gains) AddDriveGains(*gains, &json);
  OutputFolder out(OutFromFlags());
  if (is_refined && result.solved) {
    const std::string why_not = WhyNotRefined(robot, options);
    report += why_not.empty()
                  ? AddRefinedOutputs(robot,
                                      CalibrateNonlinear(robot, result, refine,
                                                         &training, held_out),
                                      &json, &out)
                  : "no robot file: " + why_not + "\n";
  }
  out.Add("calibration.json", json.dump(2) + "\n");
  out.Add("covariance.csv", CovarianceCsv(result));
  out.Add("outliers.csv", OutlierCsv(robot, training));
  out.Write();
  for (const std::string& note : robot.notes) {
    std::cout << "note       " << note << "\n";
  }
  std::cout << report;
  return Shortcomings(robot, result).empty() ? kExitOk : kExitNegative;
}

std::vector<std::string> FlagNames() {
  std::vector<std::string> names = InputFlagNames();
  for (const char* name :
       {"geometry", "identification", "solver", "loss", "joint_terms",
        "coulomb_width", "window", "intervals", "interval", "quadrature",
        "estimate", "trust", "trajectory", "payload_mass", "payload_log",
        "poses"}) {
    names.push_back(name);
  }
  return names;
}

}  // namespace

Command CalibrateCommand() {
  return {"calibrate",
          "model parameters of an arm from logs of its joint positions and "
          "torques, with standard deviations, ranks and a held-out check",
          FlagNames(), &RunCalibrate};
}

}  // namespace armcal
