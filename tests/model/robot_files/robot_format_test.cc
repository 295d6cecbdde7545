#include "model/robot_files/robot_format.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "model/dynamics/inverse_dynamics.h"
#include "model/robot/kinematics.h"
#include "model/robot_files/mjcf/mjcf_reader.h"
#include "model/robot_files/mjcf_writer.h"
#include "model/robot_files/robot_formats.h"
#include "model/robot_files/robot_reader.h"
#include "model/robot_files/sdf_writer.h"
#include "model/robot_files/urdf_reader.h"
#include "model/robot_files/urdf_writer.h"
#include "model/robot_files/yaml_writer.h"
#include "tests/fixtures/random_motion.h"
#include "tests/fixtures/temp_file.h"
#include "tests/fixtures/urdf_skeleton.h"

namespace armcal::robot_format_test {

using Eigen::VectorXd;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Fixed links, odd axes, a tool; see urdf_skeleton.h.
Robot UrdfArm() { return ReadUrdf(WriteFile(kFile, "arm.urdf"), {}); }

Robot ReadBack(const RobotFormat& format, const Robot& robot) {
  return ReadRobot(WriteFile(format.write({robot, {}}), format.file), {});
}

const RobotFormat& Format(const std::string& name) {
  for (const RobotFormat& format : RobotFormats()) {
    if (format.name == name) return format;
  }
  ADD_FAILURE() << name;
  return RobotFormats().front();
}

// All torques of joints that move and the tool's place, to `tolerance`.
void ExpectSame(const Robot& a, const Robot& b, double tolerance) {
  ASSERT_EQ(a.num_joints(), b.num_joints());
  std::mt19937_64 random(5);
  const int n = a.num_joints();
  for (int k = 0; k < 20; ++k) {
    const VectorXd q = UniformVector(&random, n, -3, 3);
    const VectorXd qd = UniformVector(&random, n, -2, 2);
    const VectorXd qdd = UniformVector(&random, n, -5, 5);
    const VectorXd tau = InverseDynamics(a, q, qd, qdd);
    EXPECT_LE((InverseDynamics(b, q, qd, qdd) - tau).norm(),
              tolerance * tau.norm());
    EXPECT_LE((ToolPose(a, q).matrix() - ToolPose(b, q).matrix()).norm(),
              tolerance);
  }
  for (int i = 0; i < n; ++i) {
    const Joint &x = a.links[i].joint, &y = b.links[i].joint;
    EXPECT_EQ(a.links[i].name, b.links[i].name);
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.type, y.type);
    EXPECT_EQ(x.lower, y.lower);
    EXPECT_EQ(x.upper, y.upper);
    EXPECT_EQ(x.effort, y.effort);
    EXPECT_EQ(x.viscous, y.viscous);
    EXPECT_EQ(x.coulomb, y.coulomb);
    EXPECT_EQ(x.armature, y.armature);
    EXPECT_EQ(x.offset, y.offset);
  }
  EXPECT_EQ(a.tool_name, b.tool_name);
}

// Of robots that branch, with the name that the formats' readers need.
TEST(RobotFormat, RobotsThatBranch) {
  std::mt19937_64 random(8);
  for (int trial = 0; trial < 20; ++trial) {
    const int n = 3 + trial % 7;
    Robot robot = RandomTree(n, trial, &random);
    RobotReaderOptions options;
    options.gravity = robot.gravity;
    for (int i = 0; i < n; ++i) {
      robot.links[i].name = "l" + std::to_string(i);
      Joint& joint = robot.links[i].joint;
      joint.name = "j" + std::to_string(i);
      joint.effort = 100;
      joint.velocity = 3;
      if (joint.type == JointType::kContinuous) continue;
      joint.lower = -2;
      joint.upper = 2;
    }
    robot.tool_name = "tool";  // on the last link
    for (const int tip : TipsOf(robot.parents, n)) {
      options.tip += tip + 1 < n ? robot.links[tip].name + "," : "tool";
    }
    for (const RobotFormat& format : RobotFormats()) {
      if (!format.is_whole) continue;
      SCOPED_TRACE(std::string(format.name) + std::to_string(trial));
      RobotReaderOptions own = options;
      if (std::string(format.name) == "yaml") own.tip = "";
      const Robot read =
          ReadRobot(WriteFile(format.write({robot, {}}), format.file), own);
      ExpectSame(robot, read, 1e-9);
    }
  }
}

// Bit for bit.
void ExpectSameNumbers(const Robot& a, const Robot& b) {
  ExpectSame(a, b, 1e-14);
  for (int i = 0; i < a.num_joints(); ++i) {
    const Link &x = a.links[i], &y = b.links[i];
    EXPECT_EQ(x.X_PF.matrix(), y.X_PF.matrix());
    EXPECT_EQ(x.X_ML.matrix(), y.X_ML.matrix());
    EXPECT_EQ(x.inertial.ToVector(), y.inertial.ToVector());
    EXPECT_EQ(x.joint.velocity, y.joint.velocity);
  }
  EXPECT_EQ(a.X_LT.matrix(), b.X_LT.matrix());
  EXPECT_EQ(a.gravity, b.gravity);
}

Robot WithJointTerms(Robot robot) {
  for (Link& link : robot.links) {
    link.joint.armature = .1;
    link.joint.coulomb = 1. / 3;
    link.joint.offset = -.7;
  }
  return robot;
}

TEST(RobotFormat, MjcfAndYamlAreTheUrdfsRobot) {
  const Robot robot = WithJointTerms(UrdfArm());
  ExpectSame(robot, ReadBack(Format("mjcf"), robot), 1e-12);
  ExpectSameNumbers(robot, ReadBack(Format("yaml"), robot));
  // And again, from one to the other.
  ExpectSame(robot, ReadBack(Format("yaml"), ReadBack(Format("mjcf"), robot)),
             1e-12);
}

TEST(RobotFormat, TablesStayTables) {
  for (const std::string& name : SampleRobotNames()) {
    std::mt19937_64 random(3);
    Robot robot = SampleRobot(name);
    SetRandomInertials(&random, &robot);
    robot.links[0].unknown_lengths = {"a"};
    const Robot back = ReadBack(Format("yaml"), robot);
    EXPECT_EQ(back.dh_convention, robot.dh_convention);
    EXPECT_THAT(back.links[0].unknown_lengths, ElementsAre("a"));
    ExpectSame(robot, back, 1e-13);
    // What is no row of a table any more is written as it is.
    robot.links[0].X_PF.translate(Eigen::Vector3d(0, .1, 0));
    const Robot moved = ReadBack(Format("yaml"), robot);
    EXPECT_FALSE(moved.dh_convention);
    ExpectSameNumbers(robot, moved);
  }
}

// Between two joints of one MJCF body; a body that has no inertia may have any.
TEST(RobotFormat, MjcfAndYamlSayThatALinkHasNoMass) {
  const Robot robot = ReadMjcf(
      {"two.xml",
       "<mujoco><worldbody><body name='a'><joint name='q1' axis='0 0 1'/>"
       "<body name='b'><joint name='q2' axis='0 1 0'/>"
       "<joint name='q3' axis='1 0 0'/><inertial pos='0 0 .2' mass='2' "
       "diaginertia='.02 .02 .01'/></body></body></worldbody></mujoco>"},
      {});
  for (const Robot& read : {robot, ReadBack(Format("yaml"), robot),
                            ReadBack(Format("mjcf"), robot)}) {
    const std::vector<Link>& links = read.links;
    const size_t between = links.size() - 2;
    EXPECT_EQ(links[between].joint.name, "q2");
    EXPECT_TRUE(IsDeclaredMassless(links[between]));
    EXPECT_FALSE(IsDeclaredMassless(links[between + 1]));
  }
  EXPECT_FALSE(IsDeclaredMassless(robot.links[0]));
  EXPECT_FALSE(IsDeclaredMassless(ReadBack(Format("yaml"), robot).links[0]));
}

TEST(RobotFormat, YamlHoldsAnyName) {
  Robot robot = UrdfArm();
  robot.name = "a \"robot\": \\ #1";
  robot.links[0].name = "- {link}";
  const Robot back = ReadBack(Format("yaml"), robot);
  EXPECT_EQ(back.name, robot.name);
  EXPECT_EQ(back.links[0].name, robot.links[0].name);
}

TEST(RobotFormat, LossesAreWhatTheFormatHasNoFieldFor) {
  RobotDescription description{UrdfArm(), {}};
  description.robot.gravity = {0, 0, -9.81};
  const std::string limits =
      "URDF requires limits; where the robot has none they are wide (effort "
      "1e+06 of turn; velocity 1000 of turn)";
  const std::string masses =
      "MuJoCo refuses a URDF whose links move without mass (wrist)";
  EXPECT_THAT(Losses(Format("urdf"), description), ElementsAre(limits, masses));
  EXPECT_THAT(Losses(UpdatedUrdfFormat(), description), IsEmpty());
  EXPECT_THAT(Losses(Format("yaml"), description), IsEmpty());
  EXPECT_THAT(Losses(Format("mjcf"), description),
              ElementsAre("MJCF has no field for velocity limits (shoulder 3, "
                          "rail 3)",
                          "MuJoCo refuses link wrist, which moves without "
                          "mass"));
  description.drives.resize(3);
  description.drives[1] = {50, .1, .9};
  description.robot.links[0].joint.offset = 2;
  EXPECT_THAT(Losses(Format("urdf"), description),
              ElementsAre("URDF has no field for constant torque (shoulder 2)",
                          "URDF has no field for springs (rail 50)",
                          "URDF has no field for torque given per torque asked "
                          "(rail 0.9)",
                          limits, masses));
  EXPECT_THAT(Losses(Format("sdf"), description),
              Contains(HasSubstr("constant torque (shoulder 2)")));
  EXPECT_THAT(Losses(Format("sdf"), description),
              testing::Not(Contains(HasSubstr("springs"))));
  EXPECT_THAT(Losses(Format("yaml"), description),
              Contains("YAML has no field for springs (rail 50)"));
}

// The comment is behind an XML's declaration and takes the place of one that
// was there; a file with it is read as before.
TEST(RobotFormat, WritesAComment) {
  const Robot arm = UrdfArm();
  for (const RobotFormat& format : RobotFormats()) {
    SCOPED_TRACE(format.name);
    const std::string text = format.write({arm, {}});
    const std::string once = WithComment(format, text, {"old--joint", "b"});
    const std::string twice = WithComment(format, once, {"new"});
    EXPECT_THAT(once, HasSubstr("armcal: old- -joint; b"));
    EXPECT_EQ(twice, WithComment(format, text, {"new"}));
    EXPECT_EQ(WithComment(format, twice, {}), text);
    if (!format.is_whole) continue;
    EXPECT_EQ(
        ReadRobot(WriteFile(once, format.file), {}).links[1].joint.viscous,
        arm.links[1].joint.viscous);
  }
}

}  // namespace armcal::robot_format_test
