#include "calib/poses/correction/correction_check.h"

#include "calib/numerics/median.h"
#include "calib/poses/correction/joint_correction.h"
#include "calib/poses/fit.h"
#include "calib/poses/pose_solution.h"
#include "model/robot/kinematics.h"
#include "model/text/option_error.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

double FrameLeaves(const Robot& robot, const PoseMeasurements& measured) {
  PoseCalibrationOptions options;
  options.refine = RefineGeometry::kNothing;
  PoseFit fit(robot, measured, options);
  const PoseSolution solution = SolvePoses(measured, options.refine, &fit);
  if (!solution.refusal.empty()) {
    throw OptionError(OptionName("validate") + ": " + solution.refusal);
  }
  return Rms(solution.before);
}

}  // namespace

CorrectionCheck CheckCorrection(const ActualArm& arm,
                                const PoseMeasurements& held_out) {
  // The refined links are at the actual pose where joints stand, but for what
  // bends the base and the tool, which joint positions make up for.
  const auto by_links = [&](const Eigen::VectorXd& q) {
    return ToolPose(arm.links(), q);
  };
  PoseMeasurements standing = held_out;
  for (Eigen::Index k = 0; k < standing.q.rows(); ++k) {
    const Eigen::VectorXd q = held_out.q.row(k);
    standing.q.row(k) =
        NearestPosture(by_links, arm.ToolPose(q), arm.Standing(q));
  }
  return {held_out.size(), FrameLeaves(arm.file(), held_out),
          FrameLeaves(arm.links(), standing)};
}

}  // namespace armcal
