#include "model/robot_files/urdf_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "model/robot/kinematics.h"
#include "model/robot_files/mjcf/mjcf_reader.h"
#include "model/robot_files/yaml_reader.h"
#include "tests/fixtures/same_robot.h"

namespace armcal::urdf_writer_test {

using Eigen::VectorXd;

void AddToolAndFriction(Robot* robot) {
  robot->tool_name = "tcp";
  robot->X_LT.linear() = RotationFromRpy({.3, -.2, 1});
  robot->X_LT.translation() << .01, -.02, .15;
  for (Link& link : robot->links) {
    link.joint.viscous = .123456789;
    link.joint.coulomb = 1 / 3.;
    link.joint.upper = 8;  // more than a turn
  }
}

// Three joints with limits, and links with mass whose frames are at them.
Robot Limited() {
  std::mt19937_64 random(6);
  Robot robot = SampleRobot("3R elbow");
  SetRandomInertials(&random, &robot);
  for (Link& link : robot.links) {
    link.X_PF = link.X_PF * link.X_ML;
    link.X_ML.setIdentity();
    link.joint.lower = -2;
    link.joint.upper = 2;
    link.joint.velocity = 3;
    link.joint.effort = 100;
  }
  return robot;
}

TEST(MakeUrdf, StandardDhRobotsComeBack) {
  std::mt19937_64 random(1);
  std::vector<Robot> robots;
  for (const auto& name : SampleRobotNames()) {
    robots.push_back(SampleRobot(name));
  }
  for (int n = 1; n < 8; ++n) robots.push_back(RandomArm(n, &random));
  for (Robot& robot : robots) {
    SCOPED_TRACE(robot.name);
    SetRandomInertials(&random, &robot);
    AddToolAndFriction(&robot);
    ExpectSameRobot(robot, ReadBack(MakeUrdf(robot), robot.gravity));
  }
}

TEST(MakeUrdf, ModifiedDhRobotsComeBack) {
  std::mt19937_64 random(2);
  for (int run = 0; run < 8; ++run) {
    Robot robot = RandomArm(6, &random);
    robot.dh_convention = DhConvention::kModified;
    for (Link& link : robot.links) {
      const VectorXd v = UniformVector(&random, 4, -1, 1);
      const double d = run % 2 == 0 ? 0 : v[1];  // joint frame and link's
      SetDhPose({v[0], d, v[2], v[3]}, DhConvention::kModified, &link);
    }
    SetRandomInertials(&random, &robot);
    AddToolAndFriction(&robot);
    ExpectSameRobot(robot, ReadBack(MakeUrdf(robot), robot.gravity));
  }
}

TEST(MakeUrdf, NamesDoNotClash) {
  std::mt19937_64 random(3);
  Robot robot = SampleRobot("3R elbow");
  SetRandomInertials(&random, &robot);
  AddToolAndFriction(&robot);
  robot.links[0].name = "base_link";
  robot.links[2].joint.name = "tcp_joint";
  ExpectSameRobot(robot, ReadBack(MakeUrdf(robot), robot.gravity));
}

// The second joint of an MJCF body need not be at the body's frame. Where
// MuJoCo 4.0.0 has that frame, which is what armcal has as the tool.
TEST(MakeUrdf, AFrameThatIsNotAtItsJointStays) {
  const Robot robot = ReadMjcf(
      {"x.xml",
       "<mujoco><worldbody><body name='l1' pos='0 0 .2'>"
       "<joint name='q1' axis='0 .3 1'/><inertial pos='.02 .01 .1' mass='3' "
       "diaginertia='.03 .025 .02'/><body name='l2' pos='.1 0 .3'>"
       "<joint name='q2' axis='0 1 0' pos='.05 .02 .01'/><inertial "
       "pos='.15 .02 .01' mass='2' diaginertia='.005 .03 .031'/></body></body>"
       "</worldbody></mujoco>"},
      {});
  const Robot again = ReadBack(MakeUrdf(robot), robot.gravity);
  EXPECT_EQ(again.links[1].name, "l2");
  EXPECT_EQ(again.tool_name, "l2_frame");
  const Eigen::Isometry3d X_WT = ToolPose(again, Eigen::Vector2d(.7, -.4));
  EXPECT_LE((X_WT.translation() - Eigen::Vector3d(0.13455760245102108,
                                                  0.08475081238166847,
                                                  0.4558932292300381))
                .norm(),
            1e-12);
  EXPECT_NEAR(X_WT.linear()(0, 0), 0.7765533221565338, 1e-12);
  EXPECT_NEAR(X_WT.linear()(2, 1), 0.06472233377491143, 1e-12);
  EXPECT_THAT(UrdfLosses(robot),
              testing::Contains(
                  "URDF has the frames of links at their joints; those that "
                  "the robot has elsewhere are links of their own (l2_frame)"));
}

// A tool stands on such a frame, or the chain would have two ends.
TEST(MakeUrdf, AToolOnAFrameThatIsNotAtItsJoint) {
  std::mt19937_64 random(4);
  Robot robot = SampleRobot("3R elbow");
  SetRandomInertials(&random, &robot);
  AddToolAndFriction(&robot);
  const Robot again = ReadBack(MakeUrdf(robot), robot.gravity);
  EXPECT_EQ(again.tool_name, "tcp");
  ExpectSameRobot(robot, again);
}

TEST(UrdfLosses, LimitsAndMasses) {
  Robot robot = Limited();
  EXPECT_TRUE(UrdfLosses(robot).empty());
  robot.links[0].joint.effort = std::numeric_limits<double>::infinity();
  robot.links[1].joint.velocity = std::numeric_limits<double>::infinity();
  robot.links[2].joint.upper = std::numeric_limits<double>::infinity();
  robot.links[1].inertial = InertialParameters();
  EXPECT_EQ(
      UrdfLosses(robot),
      (std::vector<std::string>{
          "URDF requires limits; where the robot has none they are wide "
          "(effort 1e+06 of joint1; velocity 1000 of joint2; positions "
          "within 6.283 of joint3)",
          "MuJoCo refuses a URDF whose links move without mass (link2)"}));
}

TEST(UrdfLosses, NamesWhatUrdfCannotSay) {
  Robot robot = Limited();
  EXPECT_TRUE(UrdfLosses(robot).empty());
  robot.links[1].joint.armature = .5;
  robot.links[2].joint.offset = -2;
  robot.gravity = {0, 0, 9.8};  // upwards
  EXPECT_EQ(UrdfLosses(robot),
            (std::vector<std::string>{
                "URDF has no field for armature (joint2 0.5)",
                "URDF has no field for constant torque (joint3 -2)",
                "URDF has no field for gravity, which here is 0 0 9.8 m/s^2, "
                "not along -z"}));
}

// One sentence for all joints of a kind, four digits, signs and small values
// as they are.
TEST(UrdfLosses, AreOneSentencePerKind) {
  Robot robot = Limited();
  robot.links[0].joint.armature = 8.34567;
  robot.links[1].joint.armature = 12345.6;
  robot.links[2].joint.armature = 2.00004e-7;
  robot.links[0].joint.offset = -.25;
  robot.links[2].joint.offset = 1. / 3;
  EXPECT_EQ(UrdfLosses(robot),
            (std::vector<std::string>{
                "URDF has no field for armature (joint1 8.346, joint2 "
                "1.235e+04, joint3 2e-07)",
                "URDF has no field for constant torque (joint1 -0.25, joint3 "
                "0.3333)"}));
}

}  // namespace armcal::urdf_writer_test
