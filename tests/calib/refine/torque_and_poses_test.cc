// Torques and poses in one estimate.

#include <gtest/gtest.h>

#include "calib/linear/calibrate_linear.h"
#include "calib/poses/calibration.h"
#include "tests/calib/refine/bent_arm.h"

namespace armcal::torque_and_poses_test {

NonlinearCalibrationOptions Options(RefineGeometry refine) {
  NonlinearCalibrationOptions options;
  options.trust = {BentArm::kInertia, BentArm::kLength, BentArm::kAngle};
  options.refine = refine;
  return options;
}

class Instruments : public testing::TestWithParam<Instrument> {};

// The robot comes near to the truth in both that torques and that poses show,
// which neither can alone.
TEST_P(Instruments, FindGeometryAndInertia) {
  BentArm arm("UR5 6R", 7);
  LogReaderOptions reader;
  reader.joint_names = arm.file.JointNames();
  LogSet log({arm.Record(20)}, reader, {});
  const PoseMeasurements poses = arm.Measure(GetParam(), 60, 1e-4);
  const Log unseen = arm.Move(10, .02);
  const auto linear = CalibrateLinear(arm.file, {}, log, nullptr);
  const auto both = CalibrateNonlinear(
      arm.file, linear, Options(RefineGeometry::kAll), log, nullptr, &poses);
  ASSERT_TRUE(both.converged()) << both.reason;
  const auto rigid = CalibrateNonlinear(
      arm.file, linear, Options(RefineGeometry::kNothing), log, nullptr);
  EXPECT_LT(TorqueError(both.robot, unseen), .2);
  EXPECT_LT(TorqueError(both.robot, unseen),
            .5 * TorqueError(rigid.robot, unseen));
  EXPECT_LT(both.poses->rms, .1 * both.poses->before_rms);
  if (GetParam() == Instrument::kPoses) {  // else the tool is not seen
    EXPECT_LT(ToolError(both.robot, arm.truth), 2e-4);
    EXPECT_GT(ToolError(arm.file, arm.truth), 2e-3);
  }
  for (const Link& link : both.robot.links) {
    EXPECT_EQ(WhyUnphysical(link.inertial), "") << link.name;
  }
  int far = 0;
  for (size_t k = 0; k < both.parameters.size(); ++k) {
    const PhysicalParameter& p = both.parameters[k];
    EXPECT_TRUE(std::isfinite(p.value)) << p.name;
    const bool instrument = p.name.rfind("instrument", 0) == 0;
    if (instrument || p.name.rfind("target", 0) == 0) continue;
    if (p.name.rfind("wire", 0) == 0) continue;
    const double sd = std::sqrt(both.covariance(k, k));
    far += sd > 0 && std::abs(p.value - arm.ValueOf(p)) > 3.5 * sd;
  }
  EXPECT_LE(far, 1);
}

INSTANTIATE_TEST_SUITE_P(, Instruments,
                         testing::Values(Instrument::kTargets,
                                         Instrument::kPoses,
                                         Instrument::kWire));

// Read again, poses tell nothing new of an arm that does not stand where it
// says.
TEST(TorqueAndPoses, ReadingsOfAPoseShareItsError) {
  BentArm arm("UR5 6R", 7);
  LogReaderOptions reader;
  reader.joint_names = arm.file.JointNames();
  LogSet log({arm.Record(10)}, reader, {});
  PoseMeasurements once = arm.Measure(Instrument::kTargets, 60, 1e-4);
  for (double& q : once.q.reshaped()) q += 1e-3 * Normal(&arm.random);
  PoseMeasurements thrice = once;
  std::vector<int> rows;
  for (int k = 0; k < 3 * once.size(); ++k) rows.push_back(k / 3);
  thrice.q = once.q(rows, Eigen::all);
  for (Eigen::MatrixXd& target : thrice.targets) {
    target = target(rows, Eigen::all).eval();
    for (double& x : target.reshaped()) x += 1e-6 * Normal(&arm.random);
  }
  thrice.row.resize(rows.size());
  const auto linear = CalibrateLinear(arm.file, {}, log, nullptr);
  const auto calibrate = [&](const PoseMeasurements& poses) {
    return CalibrateNonlinear(arm.file, linear, Options(RefineGeometry::kAll),
                              log, nullptr, &poses);
  };
  const auto one = calibrate(once), three = calibrate(thrice);
  ASSERT_TRUE(one.converged() && three.converged());
  int compared = 0;
  for (size_t k = 0; k < one.parameters.size(); ++k) {
    const PhysicalParameter& p = one.parameters[k];
    if (!p.geometry || !p.identifiable) continue;
    const double ratio = three.parameters[k].stddev / p.stddev;
    EXPECT_GT(ratio, .95) << p.name;  // the root of a third if they did
    EXPECT_LT(ratio, 1.5) << p.name;  // poses weigh thrice beside torques
    ++compared;
  }
  EXPECT_GE(compared, 10);
}

TEST(TorqueAndPoses, TooFewPosesAreRefused) {
  BentArm arm("UR5 6R", 8);
  LogReaderOptions reader;
  reader.joint_names = arm.file.JointNames();
  LogSet log({arm.Record(10)}, reader, {});
  const PoseMeasurements poses = arm.Measure(Instrument::kPoses, 3, 1e-4);
  const auto linear = CalibrateLinear(arm.file, {}, log, nullptr);
  const auto result = CalibrateNonlinear(
      arm.file, linear, Options(RefineGeometry::kAll), log, nullptr, &poses);
  EXPECT_FALSE(result.solved);
  EXPECT_NE(result.reason.find("measure more positions"), std::string::npos)
      << result.reason;
}

// Torques alone tell the lengths between axes, the base's tilt and what the
// file's geometry costs.
TEST(TorqueAndPoses, TorquesAloneRefineTheGeometry) {
  BentArm arm("PUMA560 6R", 9);
  LogReaderOptions reader;
  reader.joint_names = arm.file.JointNames();
  LogSet log({arm.Record(20)}, reader, {});
  const Log unseen = arm.Move(10, .02);
  const auto linear = CalibrateLinear(arm.file, {}, log, nullptr);
  const auto result = CalibrateNonlinear(
      arm.file, linear, Options(RefineGeometry::kAll), log, nullptr);
  ASSERT_TRUE(result.converged()) << result.reason;
  EXPECT_LT(TorqueError(result.robot, unseen), .25);
  bool seen = false;
  for (const PhysicalParameter& p : result.parameters) {
    if (p.name != "link2.a") continue;
    seen = p.identifiable;
    EXPECT_LT(p.stddev, .6 * BentArm::kLength);
    EXPECT_NEAR(p.value, arm.ValueOf(p), 3 * p.stddev);
  }
  EXPECT_TRUE(seen);
}

}  // namespace armcal::torque_and_poses_test
