#include "tools/calibrate_poses.h"

#include <gflags/gflags.h>

#include <iostream>

#include "calib/pose_calibration.h"
#include "calib/pose_report.h"
#include "calib/verdict.h"
#include "model/pose_reader.h"
#include "model/urdf_update.h"
#include "model/urdf_writer.h"
#include "tools/calibrate_refined.h"
#include "tools/command.h"
#include "tools/input_flags.h"
#include "tools/output_folder.h"

DECLARE_string(geometry);
DECLARE_string(log);

DEFINE_string(poses, "",
              "CSV of measured poses: q1.. with x1 y1 z1 [x2 ..] (targets), "
              "x y z qw qx qy qz (tool poses) or length1 (draw wire)");

namespace armcal {

bool PosesAloneFromFlags() { return !FLAGS_poses.empty() && FLAGS_log.empty(); }

int CalibratePosesFromFlags(const Robot& robot) {
  using Refine = RefineGeometry;
  PoseCalibrationOptions options;
  options.refine = ParseChoice<Refine>("geometry", FLAGS_geometry,
                                       {{"known", Refine::kNothing},
                                        {"offsets", Refine::kOffsets},
                                        {"refine", Refine::kAll}});
  options.loss = LossFromFlags().value_or(options.loss);
  const ArmTrust trust = TrustFromFlags();
  options.prior_length = trust.length;
  options.prior_angle = trust.angle;
  const PoseMeasurements measured = ReadPoses(FLAGS_poses, robot.JointNames());
  const PoseCalibration result = CalibratePoses(robot, measured, options);
  OutputFolder out(OutFromFlags());
  out.Add("calibration.json", PoseJson(robot, measured, result).dump(2) + "\n");
  if (result.solved) {
    out.Add("robot.urdf", robot.dh_convention
                              ? MakeUrdf(result.robot)
                              : UpdateUrdf(RobotPathFromFlags(), result.robot,
                                           true, BaseFromFlags()));
  }
  out.Write();
  std::cout << PoseReport(robot, measured, result);
  return Shortcomings(robot, result).empty() ? kExitOk : kExitNegative;
}

}  // namespace armcal
