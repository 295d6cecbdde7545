#include "model/robot_files/yaml_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/fixtures/yaml_text.h"

namespace armcal::yaml_reader_test {

using namespace yaml_text;

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(YamlReader, ReadsEveryField) {
  const Robot robot = Read(kScara);
  EXPECT_EQ(robot.name, "scara");
  EXPECT_EQ(robot.gravity, Vector3d(0, 0, 9.8));
  EXPECT_THAT(robot.JointNames(), ElementsAre("shoulder", "joint2", "joint3"));
  EXPECT_THAT(robot.notes, IsEmpty());
  const Link& upper = robot.links[0];
  EXPECT_EQ(upper.name, "upper");
  EXPECT_EQ(upper.joint.type, JointType::kRevolute);
  EXPECT_EQ(upper.joint.lower, -1);
  EXPECT_EQ(upper.joint.upper, 2);
  EXPECT_EQ(upper.joint.velocity, 3);
  EXPECT_EQ(upper.joint.effort, 10);
  EXPECT_EQ(upper.joint.viscous, 0.5);
  EXPECT_EQ(upper.joint.coulomb, 0.25);
  EXPECT_EQ(upper.joint.armature, 0.125);
  EXPECT_THAT(upper.unknown_lengths, ElementsAre("a", "d"));
  EXPECT_THAT(upper.zero_inertials, ElementsAre("hz", "Ixy"));
  Vector10d expected;
  expected << 5, -1, 0, 0, 0.1, 0, 0.2 + 5 * 0.04, 0, 0, 0.3 + 5 * 0.04;
  EXPECT_LT((upper.inertial.ToVector() - expected).norm(), 1e-15);
  EXPECT_EQ(robot.links[1].name, "link2");
  EXPECT_EQ(robot.links[1].joint.type, JointType::kContinuous);
  EXPECT_EQ(robot.links[1].joint.upper, kInfinity);
  EXPECT_FALSE(robot.links[1].has_inertial);
  expected << 2, 0, 0, 0, 1, 0.1, 2, 0.2, 0.3, 2.5;
  EXPECT_EQ(robot.links[2].inertial.ToVector(), expected);
  EXPECT_EQ(robot.tool_name, "tool");
  EXPECT_EQ(robot.dh_convention, DhConvention::kStandard);
}

// The tip of a SCARA in closed form.
TEST(YamlReader, ScaraTip) {
  const Robot robot = Read(kScara);
  const double q1 = 0.3, q2 = -0.7, q3 = 0.06;
  const Eigen::Isometry3d X = robot.links[0].X_PL(q1) *
                              robot.links[1].X_PL(q2) *
                              robot.links[2].X_PL(q3) * robot.X_LT;
  const double angle = q1 + q2 + 0.25;  // theta of the second row
  EXPECT_TRUE(X.translation().isApprox(
      Vector3d(0.4 * std::cos(q1) + 0.3 * std::cos(angle),
               0.4 * std::sin(q1) + 0.3 * std::sin(angle), 0.1 + q3 - 0.05),
      1e-15));
  const Vector3d x_axis = X.linear().col(0);
  EXPECT_TRUE(x_axis.isApprox(
      Vector3d(std::cos(angle + 0.5), std::sin(angle + 0.5), 0), 1e-15));
}

// Craig's convention moves along x before it turns about z.
TEST(YamlReader, ModifiedConventionAndDefaults) {
  const Robot robot = Read(
      "convention: modified\n"
      "links:\n"
      "  - {joint: revolute, a: 2, alpha: 1.5707963267948966, d: 3}\n");
  EXPECT_EQ(robot.name, "robot");
  EXPECT_EQ(robot.gravity, Vector3d(0, 0, -9.81));
  EXPECT_EQ(robot.tool_name, "");
  EXPECT_EQ(robot.links[0].name, "link1");
  const Eigen::Isometry3d X = robot.links[0].X_PL(0.4);
  EXPECT_TRUE(X.translation().isApprox(Vector3d(2, -3, 0), 1e-15));
  EXPECT_TRUE(Vector3d(X.linear().col(0))
                  .isApprox(Vector3d(std::cos(0.4), 0, std::sin(0.4)), 1e-15));
}

TEST(YamlReader, NotesAndOptions) {
  RobotReaderOptions options;
  options.gravity = Vector3d(1, 2, 3);
  const Robot robot = Read(
      "convention: standard\n"
      "links:\n"
      "  - {joint: revolute, mass: 0}\n"
      "  - {joint: revolute, mass: 1, inertia: [1, 1, 3]}\n",
      options);
  EXPECT_EQ(robot.gravity, Vector3d(1, 2, 3));
  EXPECT_FALSE(robot.links[0].has_inertial);
  EXPECT_THAT(
      robot.notes,
      ElementsAre(
          "link 'link1' has mass 0, read as no inertia given",
          "the inertia of link 'link2' is no rigid body's (principal moments "
          "about the centre of mass 1, 1, 3 kg m^2 break the triangle "
          "inequality); it serves as a start value only"));
  options.tip = "tool";
  EXPECT_EQ(Refusal(kScara, options),
            "`tip`: found 'tool': expected no such flag with a YAML robot, "
            "all of which is used");
}

TEST(YamlReader, ReadsBranches) {
  const std::string arms =
      "convention: poses\nlinks:\n"
      "  - {name: torso, joint: revolute}\n"
      "  - {name: left, joint: revolute}\n"
      "  - {name: hand, joint: revolute}\n"
      "  - {name: right, joint: revolute, parent: torso}\n"
      "  - {name: other, joint: revolute, parent: base}\n"
      "  - {name: its_hand, joint: revolute}\n";
  EXPECT_EQ(Read(arms).parents, (LinkParents{-1, 0, 1, 0, -1, 4}));
  EXPECT_TRUE(Read(kScara).parents.empty());
  EXPECT_THAT(
      Refusal(arms + "  - {joint: revolute, parent: hand}\n"),
      testing::HasSubstr(
          "found 'hand': expected the link before or one that carries it, as "
          "links are listed branch by branch: its_hand, other, base"));
}

class YamlRefusal : public testing::TestWithParam<Case> {};

TEST_P(YamlRefusal, SaysWhereAndWhy) {
  EXPECT_EQ(Refusal(GetParam()), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Tables, YamlRefusal,
    testing::Values(
        Case{"convention: standard\n", "",
             "line 1: expected a key 'convention'"},
        Case{"revolute", "R",
             "line 6, links[1].joint: found 'R': expected one of revolute, "
             "continuous, prismatic"},
        Case{"mass: 5", "mass: -5",
             "line 10, links[1].mass: found '-5': expected a number in kg that "
             "is not negative"},
        Case{"    mass: 5\n", "",
             "line 10, links[1].com: found '[-0.2, 0, 0]': expected the link's "
             "mass as well"},
        Case{"[0.1, 0.2, 0.3]", "[0.1, 0.2]",
             "line 12, links[1].inertia: found '[0.1, 0.2]': expected a list "
             "of Ixx, Ixy, Iyy, Ixz, Iyz, Izz or Ixx, Iyy, Izz"},
        Case{"[0.1, 0.2, 0.3]", "[0.1, -0.2, 0.3]",
             "line 12, links[1].inertia: found '[0.1, -0.2, 0.3]': expected "
             "Ixx, "
             "Iyy and Izz that are not negative"},
        Case{"lower: -1", "lower: 2",
             "line 13, links[1].limits.lower: found '2': expected less than "
             "the upper limit 2"},
        Case{"velocity: 3", "velocity: 0",
             "line 13, links[1].limits.velocity: found '0': expected a "
             "positive number in rad/s"},
        Case{"joint: revolute", "joint: continuous",
             "line 13, links[1].limits.lower: found '-1': expected no position "
             "limits of a continuous joint; is it revolute?"},
        Case{"[a, d]", "[a, alpha]",
             "line 17, links[1].unknown[2]: found 'alpha': expected one of a, "
             "d"},
        Case{"[hz, Ixy]", "[volume]",
             "line 18, links[1].zero[1]: found 'volume': expected one of mass, "
             "hx, hy, hz, Ixx, Ixy, Iyy, Ixz, Iyz, Izz"},
        Case{"[hz, Ixy]", "[mass]",
             "line 18, links[1].zero: found '[mass]': expected a mass of 0, "
             "but the link has 5 kg"},
        Case{"[hz, Ixy]", "[hx]",
             "line 18, links[1].zero: found '[hx]': expected hx to be "
             "zero, but mass, com and inertia make it -1 kg m"},
        Case{"{joint: continuous,", "{joint: continuous, joint_name: shoulder,",
             "line 19, links[2]: the joint name 'shoulder' is used before"},
        Case{"name: upper", "name: link2",
             "line 19, links[2]: the link name 'link2' is used before"},
        Case{"{z: -0.05,", "{y: 5 mm,",
             "line 21, tool.y: found '5 mm': expected a number in m"},
        Case{"{z: -0.05,", "{height: 1,",
             "line 21, tool: found 'height': expected one of the keys name, x, "
             "y, z, "
             "roll, pitch, yaw"}));

TEST(YamlReader, RefusesTooFewOrTooManyLinks) {
  EXPECT_EQ(Refusal("convention: standard\nlinks: []\n"),
            "line 2, links: found '[]': expected at least one link");
  std::string many = "convention: standard\nlinks:\n";
  for (int i = 0; i < 64; ++i) many += "  - {joint: revolute}\n";
  EXPECT_EQ(Refusal(many), "");
  EXPECT_EQ(Refusal(many + "  - {joint: revolute}\n"),
            "line 3, links: found 'a list of 65': expected at most 64 links");
}

}  // namespace armcal::yaml_reader_test
