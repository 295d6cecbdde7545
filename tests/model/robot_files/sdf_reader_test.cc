#include "model/robot_files/sdf_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "model/dynamics/inverse_dynamics.h"
#include "model/robot/kinematics.h"
#include "model/robot_files/sdf_writer.h"
#include "model/text/input_error.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::sdf_reader_test {

using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::ElementsAre;
using testing::HasSubstr;

Robot Read(const std::string& text, const RobotReaderOptions& options = {}) {
  return ReadSdf({"arm.sdf", text}, options);
}

// What armcal writes is what Drake 1.51.1 reads to 2e-15 (docs/robot_files.md).
TEST(SdfReader, ReadsWhatDrakeReads) {
  for (int seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 random(seed);
    Robot robot = RandomArm(2 + seed % 5, &random);
    SetRandomInertials(&random, &robot);
    robot.gravity = Vector3d(0, 0, -9.81);  // which a model has not
    robot.links[0].joint.viscous = 2;
    robot.links[1].joint.coulomb = 3;
    robot.links[1].joint.armature = .25;
    const Robot again = Read(MakeSdf({robot, {}}));
    const int n = robot.num_joints();
    ASSERT_EQ(again.JointNames(), robot.JointNames());
    const VectorXd q = UniformVector(&random, n, -2, 2);
    const VectorXd qd = UniformVector(&random, n, -2, 2);
    const VectorXd qdd = UniformVector(&random, n, -2, 2);
    const VectorXd expected = InverseDynamics(robot, q, qd, qdd);
    EXPECT_LE((InverseDynamics(again, q, qd, qdd) - expected).norm(),
              1e-12 * expected.norm());
    EXPECT_EQ(again.links[0].joint.viscous, 2);
    EXPECT_EQ(again.links[1].joint.coulomb, 3);
    EXPECT_EQ(again.links[1].joint.armature, .25);
    EXPECT_EQ(again.links[0].joint.lower, robot.links[0].joint.lower);
    EXPECT_EQ(again.links[0].joint.effort, robot.links[0].joint.effort);
  }
}

// Poses of links in the model's frame, a joint in a frame of its own, an axis
// in that of the model; by hand: link b stands at 1 0 2 and turns about y of
// the model through 1 0.5 2.
const char kArm[] = R"(<sdf version="1.9"><world name="w">
  <gravity>0 0 -3.7</gravity>
  <model name="arm">
    <link name="a"/>
    <link name="b"><pose>1 0 2 0 0 1.5707963267948966</pose>
      <inertial><mass>2</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz>
      </inertia></inertial></link>
    <frame name="mark" attached_to="a"><pose>1 0.5 0 0 0 0</pose></frame>
    <joint name="to_ground" type="fixed"><parent>world</parent><child>a</child>
    </joint>
    <joint name="j" type="revolute"><parent>mark</parent><child>b</child>
      <pose relative_to="mark" degrees="true">0 0 2 0 90 0</pose>
      <axis><xyz expressed_in="__model__">0 1 0</xyz>
        <limit><lower>-1e16</lower><upper>inf</upper><effort>-1</effort>
        <velocity>2</velocity></limit>
        <dynamics><damping>0.5</damping></dynamics></axis>
    </joint>
  </model></world></sdf>)";

std::string Changed(const std::string& from, const std::string& to) {
  std::string text = kArm;
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(SdfReader, FramesAndAxes) {
  const Robot robot = Read(kArm);
  EXPECT_EQ(robot.gravity, Vector3d(0, 0, -3.7));
  const Link& link = robot.links[0];
  EXPECT_EQ(link.name, "b");
  EXPECT_LE((link.X_PL(0).translation() - Vector3d(1, 0, 2)).norm(), 1e-15);
  EXPECT_LE((link.X_PL(0).linear().col(0) - Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LE((link.X_PF.linear().col(2) - Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_NEAR(link.X_PF.translation()[0], 1, 1e-15);
  EXPECT_NEAR(link.X_PF.translation()[2], 2, 1e-15);
  EXPECT_EQ(link.joint.viscous, .5);
  EXPECT_EQ(link.joint.velocity, 2);
  EXPECT_TRUE(std::isinf(link.joint.effort));
  EXPECT_TRUE(std::isinf(link.joint.lower));
  EXPECT_EQ(link.inertial.mass, 2);
}

std::string Refusal(const std::string& text) {
  try {
    Read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// A frame on a link can be a tip, and is the tool where it stands alone on the
// last link. By hand: link b's y is the model's -x, which at q = pi/2 about y
// is z; a frame 0.2 m along it is then above the link.
TEST(SdfReader, FramesOnLinks) {
  const std::string frame =
      "<frame name='tcp' attached_to='b'><pose>0 .2 0 0 0 0</pose></frame>";
  const std::string arm = Changed("</model>", frame + "</model>");
  for (const std::string tip : {"", "tcp"}) {
    RobotReaderOptions options;
    options.tip = tip;
    const Robot robot = Read(arm, options);
    EXPECT_EQ(robot.tool_name, "tcp");
    const VectorXd q = VectorXd::Constant(1, M_PI / 2);
    EXPECT_LE((ToolPose(robot, q).translation() - Vector3d(1, 0, 2.2)).norm(),
              1e-14);
  }
  EXPECT_EQ(Read(Changed("</model>", frame + "<frame name='camera' "
                                             "attached_to='b'/></model>"))
                .tool_name,
            "");
  EXPECT_THAT(Refusal(Changed("</model>",
                              "<frame name='tcp' attached_to='b'><pose "
                              "relative_to='c'/></frame></model>")),
              HasSubstr("found 'c': expected a link, joint or frame"));
}

TEST(SdfReader, LoopsAreRefused) {
  EXPECT_THAT(
      Refusal(Changed("</model>",
                      "<joint name='rod' type='ball'><parent>a</parent>"
                      "<child>b</child></joint></model>")),
      HasSubstr("joint 'rod', which closes a loop: found 'j': expected joints "
                "that move on their own"));
  EXPECT_THAT(Refusal(Changed("<dynamics>", "<mimic joint='x'/><dynamics>")),
              HasSubstr("<mimic> of joint 'j': found 'j'"));
}

TEST(SdfReader, Refusals) {
  for (const auto& [from, to, message] :
       {std::tuple{"<mass>2</mass>", "<mass>two</mass>",
                   "<mass> of link 'b': found 'two': expected a number in kg"},
        {"<mass>2</mass>", "<mass>-2</mass>", "that is not negative"},
        {"1 0 2 0 0", "1 0 2 0", "expected x y z in m and roll pitch yaw"},
        {">0 1 0<", ">0 0 0<", "expected an axis that is not zero"},
        {"<child>b", "<child>c", "found 'c': expected a link, joint or frame"},
        {"<pose>1 0.5", "<pose relative_to=\"j\">1 0.5",
         "relative to each other in a circle"},
        {"<link name=\"a\"/>", "<link name=\"b\"/>",
         "expected a name that is not yet used"},
        {"<link name=\"a\"/>", "<link name=\"a\"/><include/>",
         "<include>: expected a model that is one, of this file alone"},
        {"\"revolute\"", "\"ball\"", "found 'ball': expected a revolute"}}) {
    EXPECT_THAT(Refusal(Changed(from, to)), HasSubstr(message)) << to;
  }
  EXPECT_THAT(Refusal("<sdf><model/></sdf>"),
              HasSubstr("expected at least one <link>"));
}

// Nothing fixes it: its gravity is that of the only link without a parent.
TEST(SdfReader, AModelThatStandsByItself) {
  const Robot robot = Read(
      "<sdf version='1.9'><model name='m'><pose>0 0 0 1.5707963267948966 0 0"
      "</pose><link name='a'/><link name='b'/><joint name='j' "
      "type='continuous'><parent>a</parent><child>b</child><axis><xyz>0 0 1"
      "</xyz></axis></joint></model></sdf>");
  EXPECT_LE((robot.gravity - Vector3d(0, -9.81, 0)).norm(), 1e-14);
  EXPECT_THAT(robot.JointNames(), ElementsAre("j"));
}

}  // namespace armcal::sdf_reader_test
