#include "tools/commands/calibrate_refined.h"

#include <gflags/gflags.h>

#include <cmath>

#include "calib/refine/nonlinear_report.h"
#include "model/robot_files/robot_reader.h"
#include "model/robot_files/urdf_update.h"
#include "model/robot_files/urdf_writer.h"
#include "model/text/input_text.h"
#include "tools/command.h"
#include "tools/export_flags.h"
#include "tools/flag_choices.h"
#include "tools/input_flags.h"

DEFINE_string(
    estimate, "auto",
    "refined (model parameters and a physically consistent robot for "
    "simulators), linear (model parameters only), auto (refined where "
    "the file has masses)");
DEFINE_double(trust, 0.5,
              "relative standard deviation of the file's inertial "
              "parameters, tying what logs do not show");
DEFINE_double(
    length_trust, 0.01,
    "`M` standard deviation of the robot file's lengths where they are "
    "refined, m");
DEFINE_double(
    angle_trust, 0.02,
    "`RAD` standard deviation of the robot file's angles where they are "
    "refined, and of the base's tilt, rad");

namespace armcal {
namespace {

enum class Estimate { kAuto, kRefined, kLinear };
const FlagChoices<Estimate> kEstimates("estimate",
                                       {{"auto", Estimate::kAuto},
                                        {"refined", Estimate::kRefined},
                                        {"linear", Estimate::kLinear}});

double PositiveFlag(const std::string& name, double value,
                    const std::string& expected) {
  if (value > 0 && std::isfinite(value)) return value;
  throw UsageError("--" + name + ": found '" + NumberText(value) +
                   "', expected " + expected + " above 0");
}

std::string WhyNotRefined(const Robot& robot,
                          const LinearCalibrationOptions& options) {
  if (options.identification != Identification::kWeak) {
    return "it takes the weak form";
  }
  for (const Link& link : robot.links) {
    if (link.inertial.mass > 0) continue;
    return "the robot file gives link " + link.name + " no mass to start from";
  }
  return "";
}

void AddRobotFiles(const CommandInput& input, const Robot& robot, bool geometry,
                   OutputFolder* out) {
  const Document file = RobotFileFromFlags(input);
  if (KindOfRobotFile(file) != RobotFileKind::kUrdf) {
    out->Add("robot.urdf", MakeUrdf(robot));
    return;
  }
  out->Add("robot.urdf",
           UpdateUrdf(file, robot, geometry, BaseFromFlags(input.flags)));
  out->Add("robot_without_meshes.urdf", MakeUrdf(robot));
}

}  // namespace

ArmTrust TrustFromFlags(const FlagValues& flags) {
  return {PositiveFlag("trust", flags.Number("trust"),
                       "a relative standard deviation"),
          PositiveFlag("length_trust", flags.Number("length_trust"),
                       "a standard deviation in m"),
          PositiveFlag("angle_trust", flags.Number("angle_trust"),
                       "a standard deviation in rad")};
}

std::optional<RefineGeometry> RefineGeometryFromFlags(const FlagValues& flags) {
  if (flags.Text("geometry") == "offsets") return RefineGeometry::kOffsets;
  if (flags.Text("geometry") == "refine") return RefineGeometry::kAll;
  return std::nullopt;
}

std::optional<Refinement> RefinementFromFlags(
    const FlagValues& flags, const Robot& robot,
    const LinearCalibrationOptions& options) {
  const Estimate estimate = kEstimates.Parse(flags.Text("estimate"));
  const auto geometry = RefineGeometryFromFlags(flags);
  const bool poses = !flags.Text("poses").empty();
  ExportFromFlags(flags);  // refused before anything is calculated
  Refinement refinement;
  refinement.options.trust = TrustFromFlags(flags);
  refinement.options.pose_loss =
      LossFromFlags(flags).value_or(refinement.options.pose_loss);
  if (estimate == Estimate::kLinear) {
    if (geometry || poses) {
      throw UsageError(
          "--estimate: found 'linear', expected refined or auto: a geometry "
          "is only refined together with the robot");
    }
    return std::nullopt;
  }
  refinement.asked_for = estimate == Estimate::kRefined || geometry || poses;
  refinement.why_not = WhyNotRefined(robot, options);
  if (geometry) refinement.options.refine = *geometry;
  if (poses)
    refinement.poses = ReadPoses(flags.Text("poses"), robot.JointNames());
  return refinement;
}

void AddRobotOutputs(const CommandInput& input,
                     const NonlinearCalibration& refined,
                     const std::optional<ControllerOptions>& controller,
                     nlohmann::json* json, CommandOutcome* outcome) {
  std::string& report = outcome->output.text;
  outcome->robot = refined.robot;
  OutputFolder* const out = &outcome->folders[0];
  AddRobotFiles(input, refined.robot, refined.refined_geometry, out);
  out->Add("parameters_covariance.csv", ParametersCovarianceCsv(refined));
  for (const std::string& loss : UrdfLosses(refined.robot)) {
    report += "robot.urdf  " + loss + "\n";
  }
  report += AddExports({refined.robot, {}, controller},
                       ExportBesideUrdfFromFlags(input.flags), json, out);
}

void AddRefinedOutputs(const CommandInput& input, const Robot& robot,
                       const NonlinearCalibration& refined,
                       nlohmann::json* json, CommandOutcome* outcome) {
  AddRefined(refined, json);
  outcome->output.text += NonlinearReport(robot, refined);
  if (refined.solved) AddRobotOutputs(input, refined, {}, json, outcome);
}

}  // namespace armcal
