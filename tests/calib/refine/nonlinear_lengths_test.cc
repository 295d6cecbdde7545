// Robots with lengths that a linear calibration recovered: what they predict,
// also as the URDF file that is written of them.

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "calib/linear/calibration_model.h"
#include "calib/refine/nonlinear_report.h"
#include "model/robot_files/urdf_reader.h"
#include "model/robot_files/urdf_update.h"
#include "model/robot_files/urdf_writer.h"
#include "problems/identification_rows.h"
#include "tests/fixtures/nonlinear_runs.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::nonlinear_lengths_test {

using Eigen::VectorXd;

// The file's lengths between axes are 8 % off the truth's.
SimulatedArm MakeWrongLengths(const std::string& name,
                              std::mt19937_64* random) {
  SimulatedArm arm = MakeArm(name, .3, random);
  for (int i = 0; i + 1 < arm.file.num_joints(); ++i) {
    arm.file.links[i].X_ML.translation() *= 1.08;
  }
  return arm;
}

std::map<std::string, double> LengthsOf(const Robot& robot) {
  std::map<std::string, double> lengths;
  for (const Length& l : MakeProximalChain(robot).lengths) {
    lengths[l.owner_name] = l.value;
  }
  return lengths;
}

// The robot of a URDF; what URDF has no field for is as in `robot`.
Robot ReadBack(const std::string& urdf, const Robot& robot) {
  Robot read = ReadUrdf(WriteFile(urdf, "robot.urdf"), {});
  EXPECT_EQ(read.num_joints(), robot.num_joints());
  for (int i = 0; i < robot.num_joints(); ++i) {
    read.links[i].joint.armature = robot.links[i].joint.armature;
    read.links[i].joint.offset = robot.links[i].joint.offset;
  }
  return read;
}

// Its residuals are within 5 % of those of the linear calibration.
void ExpectHeldOut(const Robot& robot, const NonlinearRun& run) {
  ModelParameters::Options options;
  options.joint_terms = {JointTerm::kViscous, JointTerm::kCoulomb,
                         JointTerm::kOffset, JointTerm::kArmature};
  options.transitions.assign(robot.num_joints(), {kTransition});
  const ModelParameters parameters(robot, options);
  LogReaderOptions reader;
  reader.joint_names = robot.JointNames();
  LogSet logs({run.held_out}, reader, {});
  const TorqueResidual residual = EvaluateTorqueResidual(
      parameters, parameters.Values(robot), run.linear.rows.bandwidth_hz, "",
      {}, Prepare(logs, PreparationForRows(run.linear.rows)));
  const VectorXd rms = residual.moving().residual_rms;
  const VectorXd linear = run.linear.validation->moving().residual_rms;
  for (int j = 0; j < rms.size(); ++j) {
    EXPECT_LE(rms[j], 1.05 * linear[j]) << "joint " << j + 1;
  }
}

// The truth's lengths are the robot's, within what the calibration claims.
void ExpectTrueLengths(const NonlinearRun& run, const Robot& truth) {
  const auto lengths = LengthsOf(run.physical.robot);
  const auto expected = LengthsOf(truth);
  int identifiable = 0;
  for (const RecoveredLength& l : run.physical.lengths) {
    if (!l.identifiable) continue;
    ++identifiable;
    EXPECT_NEAR(lengths.at(l.name), l.value, 1e-12) << l.name;
    EXPECT_NEAR(lengths.at(l.name), expected.at(l.name), 5 * l.stddev)
        << l.name;
    // Well seen: the file's 8 % are far outside.
    if (expected.at(l.name) == 0) continue;
    EXPECT_GT(std::abs(l.nominal - expected.at(l.name)), 2 * l.stddev);
  }
  EXPECT_GT(identifiable, 1);
}

class LengthsOfArms
    : public testing::TestWithParam<std::pair<const char*, GeometryKnowledge>> {
};

TEST_P(LengthsOfArms, PredictHeldOutMotionFromTheFile) {
  std::mt19937_64 random(31);
  const SimulatedArm arm = MakeWrongLengths(GetParam().first, &random);
  NonlinearCalibrationOptions options;
  options.trust.inertia = .3;
  const NonlinearRun run =
      Calibrate(arm, .01, options, &random, GetParam().second);
  ASSERT_TRUE(run.physical.converged()) << run.physical.reason;
  EXPECT_TRUE(run.physical.refined_geometry);
  ExpectTrueLengths(run, arm.truth);
  const Robot& robot = run.physical.robot;
  ExpectHeldOut(robot, run);
  ExpectHeldOut(ReadBack(MakeUrdf(robot), robot), run);
}

// All lengths: of d2 and d3 of the PUMA, d2 to d4 of the UR5, only sums.
INSTANTIATE_TEST_SUITE_P(
    , LengthsOfArms,
    testing::Values(
        std::make_pair("PUMA560 6R", GeometryKnowledge::kNonzeroLengths),
        std::make_pair("PUMA560 6R", GeometryKnowledge::kAllLengths),
        std::make_pair("UR5 6R", GeometryKnowledge::kNonzeroLengths),
        std::make_pair("UR5 6R", GeometryKnowledge::kAllLengths)));

// A URDF, whose frames have nothing to do with the lengths, keeps its form.
TEST(NonlinearLengths, GoIntoTheUrdf) {
  std::mt19937_64 random(32);
  SimulatedArm arm = MakeWrongLengths("UR5 6R", &random);
  const std::string path = WriteFile(MakeUrdf(arm.file), "file.urdf");
  arm.file = ReadUrdf(path, {});
  arm.truth.dh_convention.reset();
  const NonlinearRun run =
      Calibrate(arm, .01, {}, &random, GeometryKnowledge::kNonzeroLengths);
  ASSERT_TRUE(run.physical.converged()) << run.physical.reason;
  ExpectTrueLengths(run, arm.truth);
  const Robot& robot = run.physical.robot;
  ExpectHeldOut(ReadBack(UpdateUrdf(path, robot, true), robot), run);
}

// Gravity along the axes shows the ratio of both lengths and none of them: of
// all of that ratio the nearest to the file's, 8 % off.
TEST(NonlinearLengths, NotSeenStayNearTheFiles) {
  std::mt19937_64 random(33);
  const SimulatedArm arm = MakeWrongLengths("SCARA RRPR", &random);
  const NonlinearRun run =
      Calibrate(arm, .01, {}, &random, GeometryKnowledge::kNonzeroLengths);
  ASSERT_TRUE(run.physical.converged()) << run.physical.reason;
  const auto lengths = LengthsOf(run.physical.robot);
  const auto file = LengthsOf(arm.file);
  ASSERT_EQ(run.physical.lengths.size(), 2u);
  Eigen::Vector2d value, change;
  for (int k = 0; k < 2; ++k) {
    const RecoveredLength& l = run.physical.lengths[k];
    EXPECT_FALSE(l.identifiable) << l.name;
    EXPECT_NEAR(lengths.at(l.name), l.value, 1e-12);
    value[k] = l.value;
    change[k] = l.value - file.at(l.name);
  }
  EXPECT_NEAR(value[0] / value[1], .4 / .3, .01);
  EXPECT_NEAR(value.dot(change), 0, 1e-9);
  ExpectHeldOut(run.physical.robot, run);
}

// The JSON has each length once, with the linear calibration's figures.
TEST(NonlinearLengths, StayInTheGeometryOfTheJson) {
  std::mt19937_64 random(34);
  const SimulatedArm arm = MakeWrongLengths("3R elbow", &random);
  NonlinearRun run =
      Calibrate(arm, .01, {}, &random, GeometryKnowledge::kNonzeroLengths);
  nlohmann::json recovered = nlohmann::json::array();
  recovered.push_back({{"name", "link1.d"}, {"value", .6}});
  nlohmann::json c = {{"geometry", recovered},
                      {"joints", nlohmann::json::array({{}, {}, {}})},
                      {"parameters", nlohmann::json::array()}};
  nlohmann::json with_tool = c;
  AddRefined(run.physical, &c);
  EXPECT_EQ(c["geometry"], recovered);
  PhysicalParameter tool = run.physical.parameters[0];
  tool.name = "tool.x";
  tool.geometry = true;
  run.physical.parameters.push_back(tool);
  const Eigen::Index size = run.physical.parameters.size();
  run.physical.covariance.conservativeResize(size, size);
  run.physical.covariance.rightCols(1).setZero();
  run.physical.covariance.bottomRows(1).setOnes();
  AddRefined(run.physical, &with_tool);
  ASSERT_EQ(with_tool["geometry"].size(), 2u);
  EXPECT_EQ(with_tool["geometry"][0], recovered[0]);
  EXPECT_EQ(with_tool["geometry"][1]["name"], "tool.x");
}

}  // namespace armcal::nonlinear_lengths_test
