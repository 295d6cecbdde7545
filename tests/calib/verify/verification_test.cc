#include "calib/verify/verification.h"

#include <gmock/gmock.h>

#include <cmath>

#include "calib/verify/largest_ratio.h"
#include "model/plant/simbody_arm.h"
#include "model/text/input_error.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/temp_file.h"
#include "tests/fixtures/urdf_text.h"

namespace armcal::verification_test {

using namespace urdf_text;

using testing::ElementsAre;
using testing::HasSubstr;

void ExpectPassed(const Verification& result) {
  EXPECT_TRUE(result.passed());
  for (const VerificationCheck& check : result.Checks()) {
    EXPECT_TRUE(check.passed()) << check.name << " " << check.value;
  }
}

TEST(LargestRatio, KeepsWhatIsNotANumber) {
  LargestRatio largest;
  largest.Add(1, 4);
  EXPECT_EQ(largest.value(), .25);
  largest.Add(std::nan(""), 1);
  largest.Add(.5, 1);
  EXPECT_TRUE(std::isnan(largest.value()));
}

// Prismatic joints, a tilted base and a tool among them.
class KnownArms : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, KnownArms,
                         testing::Values("SCARA RRPR", "PUMA560 6R", "UR5 6R",
                                         "Panda 7R"));
TEST_P(KnownArms, AreTheSameInSimbody) {
  std::mt19937_64 random(3);
  Robot robot = SampleRobot(GetParam());
  SetRandomInertials(&random, &robot);
  robot.gravity = {2, -1, -9};
  robot.X_LT.translation() << .1, .2, .3;
  VerificationOptions options;
  const Verification result = VerifyDynamics(robot, options, nullptr);
  ExpectPassed(result);
  EXPECT_EQ(result.random_states, 1000);
}

// Gravity along the axes, but for rounding.
TEST(Verify, ArmThatGravityDoesNotLoad) {
  std::mt19937_64 random(8);
  Robot robot = SampleRobot("2R planar (horizontal)");
  SetRandomInertials(&random, &robot);
  const Eigen::Matrix3d R = RotationFromRpy({.3, -.7, 1.1});
  robot.links[0].X_PF.linear() = R * robot.links[0].X_PF.linear();
  robot.gravity = R * robot.gravity;
  ExpectPassed(VerifyDynamics(robot, {}, nullptr));
}

// One branch of a tree, with a link that is lumped into another, odd axes and
// products of inertia.
TEST(Verify, ChainOutOfABranchingUrdf) {
  const std::string body =
      "<inertial><origin xyz='.1 .02 -.03' rpy='.3 .2 1'/>"
      "<mass value='2'/><inertia ixx='.03' ixy='.002' "
      "ixz='-.001' iyy='.04' iyz='.003' izz='.02'/>"
      "</inertial>";
  RobotReaderOptions options;
  options.tip = "hand";
  const Robot robot = Read(
      LinkXml("base") + LinkXml("a", body) + LinkXml("plate", body) +
          LinkXml("b", body) + LinkXml("hand", body) + LinkXml("eye", body) +
          JointXml(
              "j1", "continuous", "base", "a",
              "<origin xyz='0 .1 .3' rpy='.4 0 1'/><axis xyz='.6 0 .8'/>") +
          JointXml("f", "fixed", "a", "plate", "<origin xyz='.2 0 .1'/>") +
          JointXml("j2", "prismatic", "plate", "b",
                   "<axis xyz='0 -1 0'/><limit lower='-.3' upper='.4' "
                   "effort='9' velocity='1'/>") +
          JointXml("j3", "revolute", "b", "hand",
                   "<origin xyz='0 .2 0'/><axis xyz='1 1 1'/><limit "
                   "lower='-2' upper='1' effort='9' velocity='3'/>") +
          JointXml("j4", "continuous", "b", "eye", "<axis xyz='1 0 0'/>"),
      options);
  ASSERT_EQ(robot.num_joints(), 3);
  ExpectPassed(VerifyDynamics(robot, {}, nullptr));
}

TEST(Verify, StatesOfALog) {
  std::mt19937_64 random(4);
  Robot robot = SampleRobot("3R elbow");
  SetRandomInertials(&random, &robot);
  Log log = RecordMotion(RandomMultisine(&random, 3), 20, .01);
  AddTorque(robot, &log);
  LogReaderOptions reader;
  reader.joint_names = robot.JointNames();
  LogSet logs({WriteFile(LogCsv(log))}, reader, {});
  PreparationOptions at_8_hz;
  at_8_hz.bandwidth_hz = 8;
  const PreparedLogs prepared = Prepare(logs, at_8_hz);
  VerificationOptions options;
  options.log_states = 300;
  options.random_states = 10;
  const Verification result = VerifyDynamics(robot, options, &prepared);
  ExpectPassed(result);
  EXPECT_NEAR(result.log_states, 300, 5);
}

// The published third link of the PUMA 560 cannot exist: Iyy > Ixx + Izz.
TEST(Verify, RefusedLinksAreNamedAndTheRestIsChecked) {
  std::mt19937_64 random(5);
  Robot robot = SampleRobot("PUMA560 6R");
  robot.name = "puma";
  SetRandomInertials(&random, &robot);
  robot.links[2].inertial = InertialParameters::FromCenterOfMass(
      4.8, {0, 0, .07}, Eigen::Vector3d(.066, .086, .0125).asDiagonal());
  robot.links[4].inertial = robot.links[2].inertial;
  const Verification result = VerifyDynamics(robot, {}, nullptr);
  EXPECT_FALSE(result.passed());
  EXPECT_THAT(result.reasons,
              ElementsAre(HasSubstr("puma: link link3: Simbody cannot"),
                          HasSubstr("puma: link link5: Simbody cannot")));
  EXPECT_THAT(result.reasons[0], HasSubstr("principal moments"));
  EXPECT_TRUE(std::isnan(result.torque_max_rel));
  EXPECT_LT(result.own_consistency_rel, 1e-8);
  EXPECT_LT(result.own_energy_drift_rel, 1e-6);
}

// Nothing resists the last joint.
TEST(Verify, MasslessTipCannotSwing) {
  std::mt19937_64 random(6);
  Robot robot = SampleRobot("3R elbow");
  SetRandomInertials(&random, &robot);
  robot.links[2].inertial = {};
  const Verification result = VerifyDynamics(robot, {}, nullptr);
  EXPECT_FALSE(result.passed());
  EXPECT_THAT(
      result.reasons,
      ElementsAre(HasSubstr("our dynamics cannot follow a passive swing")));
  EXPECT_LT(result.torque_max_rel, 1e-10);
}

// A pendulum of this length (m).
Robot Pendulum(double length) {
  Robot robot;
  Link link;
  link.name = "link1";
  link.joint.name = "joint1";
  link.inertial = {
      1, {length, 0, 0}, 2 * length * length * Eigen::Matrix3d::Identity()};
  link.has_inertial = true;
  robot.links = {link};
  robot.gravity = {0, -9.81, 0};  // the joint turns about z
  return robot;
}

// One of a picometre swings as often in .02 s as one of a metre in 6 h.
TEST(Verify, WhatSwingsTooFastIsToldSo) {
  const Verification result = VerifyDynamics(Pendulum(1e-12), {}, nullptr);
  EXPECT_FALSE(result.passed());
  ASSERT_EQ(result.reasons.size(), 1u);
  EXPECT_THAT(result.reasons[0], HasSubstr("more than 100000 steps up to t ="));
  EXPECT_LT(result.torque_max_rel, 1e-10);
}

// One of a tenth of a micrometre swings 1,600 times in a second.
TEST(Verify, FastOnesSwingLess) {
  const Verification result = VerifyDynamics(Pendulum(1e-7), {}, nullptr);
  EXPECT_EQ(result.reasons, std::vector<std::string>());
  EXPECT_GT(result.swing_s, 0);
  EXPECT_LT(result.swing_s, 10);
  EXPECT_LT(result.own_energy_drift_rel, 1e-6);
}

// Without a figure of Simbody's swing a robot may be verified, without one of
// ours it may not.
TEST(Verify, SimbodysSwingMayBeMissing) {
  Verification result;
  result.torque_max_rel = result.mass_matrix_max_rel = result.gravity_max_rel =
      result.energy_max_rel = result.own_energy_drift_rel =
          result.own_consistency_rel = 0;
  result.energy_drift_rel = std::nan("");
  EXPECT_TRUE(result.passed());
  result.energy_drift_rel = 1e-5;
  EXPECT_FALSE(result.passed());
  result.energy_drift_rel = result.own_energy_drift_rel = std::nan("");
  EXPECT_FALSE(result.passed());
}

// Simbody's tolerances are absolute: rounding of a thousand tons in a point is
// beyond them.
TEST(Verify, HeavyPointsAreRefusedBySimbody) {
  std::mt19937_64 random(9);
  Robot robot = SampleRobot("2R planar (vertical plane)");
  int refused = 0;
  for (int k = 0; k < 100; ++k) {
    robot.links[1].inertial = InertialParameters::FromCenterOfMass(
        1e6, UniformVector(&random, 3, -.5, .5), Eigen::Matrix3d::Zero());
    try {
      SimbodyArm arm(robot);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("Simbody cannot simulate it: "));
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
}

// Random states and the swing start are drawn from the seed alone.
TEST(Verify, SameSeedSameFigures) {
  std::mt19937_64 random(7);
  Robot robot = SampleRobot("UR5 6R");
  SetRandomInertials(&random, &robot);
  VerificationOptions options;
  options.random_states = 20;
  options.swing_s = .5;
  const auto figures = [&](std::uint64_t seed) {
    options.seed = seed;
    const Verification v = VerifyDynamics(robot, options, nullptr);
    return std::make_pair(v.torque_max_rel, v.own_energy_drift_rel);
  };
  EXPECT_EQ(figures(1), figures(1));
  EXPECT_NE(figures(1), figures(2));
}

}  // namespace armcal::verification_test
