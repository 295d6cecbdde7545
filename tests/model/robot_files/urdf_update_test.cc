#include "model/robot_files/urdf_update.h"

#include <gtest/gtest.h>

#include "model/robot/arm_geometry.h"
#include "model/text/input_error.h"
#include "tests/fixtures/same_robot.h"
#include "tests/fixtures/urdf_skeleton.h"
#include "tests/fixtures/urdf_text.h"

namespace armcal::urdf_update_test {

using Eigen::VectorXd;

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

// Two arms on one base; the first has a finger that is held.
std::string TwoArms() {
  using namespace urdf_text;
  const auto joint = [](const std::string& name, const std::string& parent,
                        const std::string& child) {
    return RodJointXml(name, parent, child, ".2 .3 .1");
  };
  return "<robot name='two'>" + LinkXml("base") + RodXml("a1") + RodXml("a2") +
         RodXml("b1") + RodXml("b2") + RodXml("finger") +
         joint("ja1", "base", "a1") + joint("ja2", "a1", "a2") +
         joint("jb1", "base", "b1") + joint("jb2", "b1", "b2") +
         joint("f", "a2", "finger") + "</robot>";
}

TEST(UpdateUrdf, BranchesAndHeldJoints) {
  const std::string path = WriteFile(TwoArms(), "two.urdf");
  RobotReaderOptions options;
  options.tip = "a2,b2";
  options.posture = {{"f", .7}};
  Robot robot = Changed(ReadUrdf(path, options));
  robot.links[2].X_PF.translation() += Eigen::Vector3d(.01, .02, .03);
  const std::string text = UpdateUrdf(path, robot, true);
  ExpectSameRobot(robot, ReadUrdf(WriteFile(text, "new.urdf"), options));
  EXPECT_NE(text.find("mass value=\"1\""), std::string::npos);  // the finger
  // At another posture the finger counts elsewhere.
  options.posture = {{"f", -.7}};
  const Robot other = ReadUrdf(WriteFile(text, "new.urdf"), options);
  EXPECT_GT((other.links[1].inertial.first_moment -
             robot.links[1].inertial.first_moment)
                .norm(),
            .05);
}

// The finger is a body of its own as soon as its joint moves: MuJoCo refused
// the file in which it had given its inertia away. Together with it the link is
// what was calibrated, also where the two cannot be so heavy.
TEST(UpdateUrdf, HeldLinksStayBodies) {
  const std::string path = WriteFile(TwoArms(), "two.urdf");
  RobotReaderOptions options;
  options.tip = "a2,b2";
  options.posture = {{"f", .7}};
  Robot robot = ReadUrdf(path, options);
  robot.links[1].inertial = InertialParameters::FromCenterOfMass(
      .8, {.1, .1, 0}, .01 * Eigen::Matrix3d::Identity());  // the finger: 1 kg
  std::vector<std::string> losses;
  const std::string text = UpdateUrdf(path, robot, false, "", &losses);
  const std::string written = WriteFile(text, "new.urdf");
  ExpectSameRobot(robot, ReadUrdf(written, options));
  options.tip = "finger,b2";
  options.posture = {};
  double mass = 0;
  for (const Link& link : ReadUrdf(written, options).links) {
    EXPECT_EQ(WhyUnphysical(link.inertial), "") << link.name;
    if (link.name == "a2" || link.name == "finger") mass += link.inertial.mass;
  }
  EXPECT_NEAR(mass, .8, 1e-12);
  ASSERT_EQ(losses.size(), 1);
  EXPECT_NE(losses[0].find("links that held joints move (finger) have 0."),
            std::string::npos)
      << losses[0];
  EXPECT_NE(losses[0].find("calibrated link a2"), std::string::npos);
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

}  // namespace armcal::urdf_update_test
