#include "model/robot_files/urdf_writer.h"

#include <gtest/gtest.h>

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

TEST(UrdfLosses, NamesWhatUrdfCannotSay) {
  Robot robot = SampleRobot("3R elbow");
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
  Robot robot = SampleRobot("3R elbow");
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
