#include "model/urdf_writer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/arm_geometry.h"
#include "model/dh_reader.h"
#include "model/input_error.h"
#include "model/inverse_dynamics.h"
#include "model/kinematics.h"
#include "model/urdf_reader.h"
#include "tests/sample_robots.h"
#include "tests/temp_file.h"
#include "tests/urdf_skeleton.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

// Both robots need the same torques (1e-8 of their size) and carry the tool the
// same way, at random states.
void ExpectSameRobot(const Robot& a, const Robot& b) {
  ASSERT_EQ(a.num_joints(), b.num_joints());
  std::mt19937_64 random(5);
  const int n = a.num_joints();
  for (int k = 0; k < 20; ++k) {
    const VectorXd q = UniformVector(&random, n, -3, 3);
    const VectorXd qd = UniformVector(&random, n, -2, 2);
    const VectorXd qdd = UniformVector(&random, n, -5, 5);
    const VectorXd tau = InverseDynamics(a, q, qd, qdd);
    EXPECT_LE((InverseDynamics(b, q, qd, qdd) - tau).norm(), 1e-8 * tau.norm());
    EXPECT_LE((ToolPose(a, q).matrix() - ToolPose(b, q).matrix()).norm(), 1e-8);
  }
  for (int i = 0; i < n; ++i) {
    const Joint &x = a.links[i].joint, &y = b.links[i].joint;
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.type, y.type);
    EXPECT_EQ(a.links[i].name, b.links[i].name);
    EXPECT_NEAR(x.viscous, y.viscous, 1e-9);
    EXPECT_NEAR(x.coulomb, y.coulomb, 1e-9);
    EXPECT_TRUE(!std::isfinite(x.upper) || std::abs(x.upper - y.upper) < 1e-9);
  }
}

Robot ReadBack(const std::string& urdf, const Eigen::Vector3d& gravity) {
  RobotReaderOptions options;
  options.gravity = gravity;
  return ReadUrdf(WriteFile(urdf, "written.urdf"), options);
}

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
  ASSERT_EQ(UrdfLosses(robot).size(), 3u);
  EXPECT_NE(UrdfLosses(robot)[0].find("armature of joint2, 0.5"), size_t(-1));
  EXPECT_NE(UrdfLosses(robot)[1].find("joint3, -2"), size_t(-1));
  EXPECT_NE(UrdfLosses(robot)[2].find("0 0 9.8"), size_t(-1));
}

std::string Replaced(std::string text, const std::string& from,
                     const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

// Another arm of the same structure: inertia heavier than its fixed links'.
Robot Changed(Robot robot) {
  for (Link& link : robot.links) {
    Vector10d V = link.inertial.ToVector();
    if (V[0] == 0) V << 1, 0, .01, 0, .02, 0, .02, 0, 0, .02;
    link.inertial = InertialParameters::FromVector(1.2 * V);
    link.joint.viscous = 2.5;
    link.joint.coulomb = .75;
  }
  return robot;
}

TEST(UpdateUrdf, ChangesOnlyNumbers) {
  const std::string path = WriteFile(kFile, "arm.urdf");
  const Robot robot = Changed(ReadUrdf(path, {}));
  const std::string text = UpdateUrdf(path, robot, false);
  ExpectSameRobot(robot, ReadBack(text, robot.gravity));
  // Added: what the file lacks. The fixed links keep theirs.
  std::string expected = Skeleton(kFile);
  const std::string dynamics = "<dynamics damping=# friction=#>";
  expected = Replaced(expected, "velocity=3>>", "velocity=3>" + dynamics + ">");
  expected = Replaced(expected, "damping=# spring=keep",
                      "damping=# spring=keep friction=#");
  expected = Replaced(expected,
                      "<mass value=#><inertia ixx=# ixy=# ixz=# "
                      "iyy=# iyz=# izz=#>>><joint name=rail",
                      "<mass value=#><inertia ixx=# ixy=# ixz=# iyy=# iyz=# "
                      "izz=#><origin xyz=# rpy=#>>><joint name=rail");
  expected = Replaced(expected, "<link name=wrist>",
                      "<link name=wrist<inertial<origin xyz=# rpy=#><mass "
                      "value=#><inertia ixx=# ixy=# ixz=# iyy=# iyz=# "
                      "izz=#>>>");
  expected = Replaced(expected, "<axis xyz=1 1 1>>",
                      "<axis xyz=1 1 1>" + dynamics + ">");
  EXPECT_EQ(Skeleton(text), expected);
  for (const char* kept : {"mass value=\"9\"", "mass value=\"1\""}) {
    EXPECT_NE(text.find(kept), std::string::npos) << kept;
  }
}

TEST(UpdateUrdf, FixedLinksGiveUpInertiaThatLeavesNone) {
  const std::string path = WriteFile(kFile, "arm.urdf");
  Robot robot = Changed(ReadUrdf(path, {}));
  robot.links[0].inertial = InertialParameters::FromCenterOfMass(
      .8, {.1, .1, 0}, .01 * Eigen::Matrix3d::Identity());  // plate alone: 1 kg
  const std::string text = UpdateUrdf(path, robot, false);
  ExpectSameRobot(robot, ReadBack(text, robot.gravity));
  EXPECT_EQ(text.find("mass value=\"1\""), std::string::npos);
  EXPECT_NE(text.find("mass value=\"9\""), std::string::npos);  // the base's
}

TEST(UpdateUrdf, GeometryGoesThroughFixedLinks) {
  const std::string path = WriteFile(kFile, "arm.urdf");
  for (const std::string base : {"", "mast", "world"}) {
    RobotReaderOptions options;
    options.base = base;
    options.gravity = Eigen::Vector3d(0, 0, -9.81);
    Robot robot = Changed(ReadUrdf(path, options));
    ArmGeometry geometry(robot);
    std::mt19937_64 random(4);
    VectorXd values = geometry.Values();
    const std::vector<std::string> names = geometry.Names();
    for (int k = 0; k < geometry.size(); ++k) {
      if (names[k].rfind("base.", 0) == 0) continue;
      values[k] += Uniform(&random, -.05, .05);
    }
    geometry.SetValues(values);
    robot = geometry.ApplyTo(robot);
    const std::string text = UpdateUrdf(path, robot, true, base);
    ExpectSameRobot(robot, ReadUrdf(WriteFile(text, "new.urdf"), options));
  }
}

TEST(UpdateUrdf, RefusesAnotherRobotsFile) {
  const std::string path = WriteFile(kFile, "arm.urdf");
  Robot robot = ReadUrdf(path, {});
  EXPECT_THROW(UpdateUrdf(path, robot, true, "nowhere"), InputError);
  EXPECT_THROW(UpdateUrdf(path, robot, true, "slide"), InputError);
  robot.links[1].joint.name = "bolts";  // is fixed
  EXPECT_THROW(UpdateUrdf(path, robot, false), InputError);
  EXPECT_THROW(UpdateUrdf(WriteFile("<a/>", "a.urdf"), robot, false),
               InputError);
}

}  // namespace
}  // namespace armcal
