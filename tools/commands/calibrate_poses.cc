#include "tools/commands/calibrate_poses.h"

#include <gflags/gflags.h>

#include "calib/poses/calibrate_poses.h"
#include "calib/poses/calibration.h"
#include "calib/poses/report.h"
#include "calib/poses/verdict.h"
#include "model/log_files/pose_reader.h"
#include "model/robot_files/robot_reader.h"
#include "model/robot_files/urdf_update.h"
#include "model/robot_files/urdf_writer.h"
#include "tools/command.h"
#include "tools/command_report.h"
#include "tools/commands/calibrate_refined.h"
#include "tools/commands/calibrate_report.h"
#include "tools/export_flags.h"
#include "tools/flag_choices.h"
#include "tools/input_flags.h"

DEFINE_string(poses, "",
              "`FILE` CSV of measured poses: q1.. and x1 y1 z1 [x2 ..], "
              "x y z qw qx qy qz, or length1 (draw wire)");

namespace armcal {
namespace {

// Those of --geometry that need no log.
const FlagChoices<RefineGeometry> kPoseGeometries(
    "geometry", {{"known", RefineGeometry::kNothing},
                 {"offsets", RefineGeometry::kOffsets},
                 {"refine", RefineGeometry::kAll}});

}  // namespace

bool PosesAloneFromFlags(const FlagValues& flags) {
  return !flags.Text("poses").empty() && flags.Text("log").empty();
}

CommandOutcome CalibratePosesFromFlags(const CommandInput& input) {
  const FlagValues& flags = input.flags;
  const Robot robot = RobotFromFlags(input);
  PoseCalibrationOptions options;
  options.refine = kPoseGeometries.Parse(flags.Text("geometry"));
  const auto formats = ExportBesideUrdfFromFlags(flags);
  options.loss = LossFromFlags(flags).value_or(options.loss);
  const ArmTrust trust = TrustFromFlags(flags);
  options.prior_length = trust.length;
  options.prior_angle = trust.angle;
  const PoseMeasurements measured =
      ReadPoses(flags.Text("poses"), robot.JointNames());
  input.Begin("fitting the poses");
  const PoseCalibration result = CalibratePoses(robot, measured, options);
  CommandOutcome outcome;
  OutputFolder& out = outcome.folders.emplace_back(OutFromFlags(flags));
  nlohmann::json json = PoseJson(robot, measured, result);
  std::string report = PoseReport(robot, measured, result);
  if (result.solved) {
    outcome.robot = result.robot;
    const Document file = RobotFileFromFlags(input);
    out.Add("robot.urdf",
            KindOfRobotFile(file) == RobotFileKind::kUrdf
                ? UpdateUrdf(file, result.robot, true, BaseFromFlags(flags))
                : MakeUrdf(result.robot));
    report += AddExports({result.robot, {}}, formats, &json, &out);
  }
  const std::string text = json.dump(2) + "\n";
  out.Add("calibration.json", text);
  const auto draw = [&](ReportContent* content) {
    if (!result.solved) return;
    content->extra["geometry"] =
        GeometryDrawing(result.robot, result.before, result.after);
  };
  AddReport(input, "calibrate", robot, text, {flags.Text("poses")}, draw, &out);
  const bool good = Shortcomings(robot, result).empty();
  outcome.output = {text, report, robot.name + ": ", good, {}};
  return outcome;
}

}  // namespace armcal
