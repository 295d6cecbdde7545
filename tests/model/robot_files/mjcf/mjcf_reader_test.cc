#include "model/robot_files/mjcf/mjcf_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "model/robot/kinematics.h"
#include "tests/fixtures/refusal.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::mjcf_reader_test {

using Eigen::Vector3d;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

// As models of real arms are: degrees in classes, servos, a gripper beside.
const char kArm[] = R"(<mujoco model="arm">
  <compiler angle="degree" autolimits="true"/>
  <option gravity="0 0 -9.8"/>
  <default>
    <default class="arm">
      <joint axis="0 1 0" range="-90 180" damping="2" armature="0.1"/>
      <general gaintype="fixed" biastype="affine" forcerange="-87 87"/>
      <default class="small"><joint frictionloss="0.5"/></default>
    </default>
  </default>
  <worldbody>
    <light pos="0 0 1"/>
    <body name="base" childclass="arm">
      <body name="upper" pos="0 0 0.5">
        <inertial pos="0.1 0 0" mass="2" diaginertia="0.1 0.2 0.3"/>
        <joint name="shoulder"/>
        <geom type="mesh" mesh="upper" class="small"/>
        <body name="lower" pos="1 0 0" quat="1 0 0 0">
          <inertial pos="0 0 0" mass="1" diaginertia="0.1 0.1 0.1"/>
          <joint name="elbow" class="small" pos="0 0 0.25" ref="90"/>
          <body name="flange" pos="0 0 1"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator>
    <general class="arm" name="a1" joint="shoulder" gainprm="4500"
             biasprm="0 -4500 -450"/>
    <motor name="a2" joint="elbow" gear="50" ctrlrange="-1 1"/>
  </actuator>
</mujoco>
)";

Robot Read(const std::string& text, const RobotReaderOptions& options = {}) {
  return ReadMjcf(WriteFile(text, "arm.xml"), options);
}

TEST(MjcfReader, ReadsModelsOfRealArms) {
  const Robot robot = Read(kArm);
  EXPECT_EQ(robot.name, "arm");
  EXPECT_EQ(robot.gravity, Vector3d(0, 0, -9.8));
  EXPECT_THAT(robot.JointNames(), ElementsAre("shoulder", "elbow"));
  EXPECT_EQ(robot.tool_name, "flange");
  const Joint& shoulder = robot.links[0].joint;
  EXPECT_EQ(shoulder.type, JointType::kRevolute);
  EXPECT_NEAR(shoulder.lower, -M_PI / 2, 1e-15);
  EXPECT_NEAR(shoulder.upper, M_PI, 1e-15);
  EXPECT_EQ(shoulder.viscous, 2);
  EXPECT_EQ(shoulder.armature, .1);
  EXPECT_EQ(shoulder.coulomb, 0);
  EXPECT_EQ(shoulder.effort, 87);
  EXPECT_EQ(shoulder.offset, 0);
  EXPECT_EQ(robot.links[1].joint.coulomb, .5);
  EXPECT_EQ(robot.links[1].joint.viscous, 2);
  EXPECT_EQ(robot.links[1].joint.effort, 50);
  // At q = ref the lower arm stands as the file has it, and turns about a point
  // 0.25 above its origin: at q = 0 by -90 degrees about y.
  const auto tool = [&](double elbow) {
    const Eigen::Vector2d q(0, elbow);
    return Vector3d(ToolPose(robot, q).translation());
  };
  EXPECT_LE((tool(M_PI / 2) - Vector3d(1, 0, 1.5)).norm(), 1e-15);
  EXPECT_LE((tool(0) - Vector3d(1 - .75, 0, .75)).norm(), 1e-15);
}

// Masses by hand: a ball of density 1000, a box of given mass.
TEST(MjcfReader, InertiaOfGeoms) {
  const Robot robot = Read(
      "<mujoco><worldbody><body><joint/><geom size='0.1'/>"
      "<geom type='box' size='.1 .2 .3' pos='1 0 0' mass='3'/>"
      "<geom type='mesh' mesh='x' density='0'/></body></worldbody></mujoco>");
  const InertialParameters& V = robot.links[0].inertial;
  const double ball = 4. / 3 * M_PI;
  EXPECT_NEAR(V.mass, ball + 3, 1e-14);
  EXPECT_LE((V.first_moment - Vector3d(3, 0, 0)).norm(), 1e-14);
  EXPECT_NEAR(V.inertia(2, 2), .4 * ball * .01 + 3 * (.01 + .04) / 3 + 3,
              1e-14);
  EXPECT_EQ(robot.links[0].joint.type, JointType::kContinuous);
  EXPECT_EQ(robot.links[0].name, "body1");
  EXPECT_EQ(robot.links[0].joint.name, "joint0");
}

TEST(MjcfReader, SaysWhatItDoesNotUse) {
  std::string text = kArm;
  text.replace(text.find("ref=\"90\""), 8, "stiffness=\"3\" ref=\"0\"");
  text.insert(text.find("</mujoco>"), "<tendon><fixed name='t'/></tendon>");
  const Robot robot = Read(text);
  EXPECT_THAT(robot.notes, Contains("the spring of joint 'elbow' is not used: "
                                    "armcal's joints have none"));
  EXPECT_THAT(robot.notes,
              Contains("not used: tendon <fixed> 't', which has no "
                       "stiffness, damping, friction or actuator"));
}

class MjcfRefusal : public testing::TestWithParam<Case> {};

TEST_P(MjcfRefusal, SaysWhereAndWhy) {
  const std::string path = WriteFile("", "arm.xml");
  EXPECT_EQ(RefusalOf(path, Changed(kArm, GetParam()),
                      [](const std::string& file) { ReadMjcf(file, {}); }),
            GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    All, MjcfRefusal,
    testing::Values(
        Case{"mass=\"2\"", "mass=\"2kg\"",
             "line 15, <inertial mass> of body 'upper': found '2kg': expected "
             "a number in kg"},
        Case{"diaginertia=\"0.1 0.2 0.3\"", "diaginertia=\"0.1 0.2\"",
             "line 15, <inertial diaginertia> of body 'upper': found '0.1 "
             "0.2': expected three numbers in kg m^2"},
        Case{" diaginertia=\"0.1 0.2 0.3\"", "",
             "line 15, <inertial> of body 'upper': expected an attribute "
             "'diaginertia'"},
        Case{"damping=\"2\"", "damping=\"-2\"",
             "line 6, <joint damping> of default class 'arm': found '-2': "
             "expected a number in N m s/rad that is not negative"},
        Case{"range=\"-90 180\"", "range=\"180 -90\"",
             "line 6, <joint range> of default class 'arm': found '180 -90': "
             "expected the smaller number first"},
        Case{"axis=\"0 1 0\"", "axis=\"0 0 0\"",
             "line 6, <joint axis> of default class 'arm': found '0 0 0': "
             "expected an axis that is not zero"},
        Case{"joint name=\"shoulder\"", "joint name=\"shoulder\" type=\"ball\"",
             "line 16, joint 'shoulder': found 'ball': expected a hinge or "
             "slide joint, or none, in the chain; `base`=upper starts behind "
             "it"},
        Case{"<joint name=\"shoulder\"/>", "<freejoint name=\"shoulder\"/>",
             "line 16, joint 'shoulder': found 'free': expected a hinge or "
             "slide joint, or none, in the chain; `base`=upper starts behind "
             "it"},
        Case{"class=\"small\" pos", "class=\"tiny\" pos",
             "line 20, <joint class> of joint 'elbow': found 'tiny': expected "
             "one of the default classes arm, main, small"},
        Case{"name=\"elbow\"", "name=\"shoulder\"",
             "line 20, <joint name> of body 'lower': found 'shoulder': "
             "expected a name that is not yet used (line 16)"},
        Case{"quat=\"1 0 0 0\"", "quat=\"0 0 0 0\"",
             "line 18, <body quat> of body 'lower': found '0 0 0 0': expected "
             "w x y z that are not all zero"},
        Case{"quat=\"1 0 0 0\"", "quat=\"1 0 0 0\" euler=\"0 0 0\"",
             "line 18, <body euler> of body 'lower': found '0 0 0': expected "
             "one orientation: there is quat already"},
        Case{
            "<body name=\"flange\" pos=\"0 0 1\"/>", "<replicate count=\"3\"/>",
            "line 21, <replicate> of body 'lower': found 'replicate': expected "
            "a body, inertial, joint, geom, site, camera, light or frame; what "
            "MuJoCo makes bodies from, its compile turns into them"},
        Case{"joint=\"elbow\" gear", "joint=\"wrist\" gear",
             "line 29, <motor joint>: found 'wrist': expected one of the "
             "joints shoulder, elbow"},
        Case{"angle=\"degree\"", "angle=\"degrees\"",
             "line 2, <compiler angle>: found 'degrees': expected degree or "
             "radian"},
        Case{"<inertial pos=\"0.1 0 0\" mass=\"2\" "
             "diaginertia=\"0.1 0.2 0.3\"/>",
             "",
             "line 17, <geom mesh> of body 'upper': found 'upper': expected a "
             "mesh of the file's <asset>"}));

TEST(MjcfReader, BaseAndTip) {
  RobotReaderOptions options;
  options.tip = "nowhere";
  EXPECT_EQ(MessageOf<InputError>(WriteFile(kArm, "arm.xml"),
                                  [&] { Read(kArm, options); }),
            "FILE: `tip`: found 'nowhere': expected one of the links world, "
            "base, upper, lower, flange");
  options.tip = "upper";
  EXPECT_THAT(Read(kArm, options).JointNames(), ElementsAre("shoulder"));
  options.tip = "";
  options.base = "upper";
  EXPECT_THAT(Read(kArm, options).JointNames(), ElementsAre("elbow"));
}

// As MuJoCo 4.0.0 compiles it: body "a" at 0.75 2.5 3, turned by a quarter
// about z, with a joint along its x through 0.5 0 0 of it; geom 1 m along its
// -z, of 48 kg and moments 0.8, 1.6, 2.08 along its x, y and z.
TEST(MjcfReader, Frames) {
  const Robot robot = Read(R"(<mujoco><worldbody>
    <frame pos="1 2 3" euler="0 0 90"><frame pos=".5 0 0">
      <body name="a" pos="0 .25 0"><frame euler="0 90 0">
        <joint axis="0 0 1" pos="0 0 .5"/>
        <geom type="box" size=".1 .2 .3" pos="1 0 0"/>
      </frame></body>
    </frame></frame></worldbody></mujoco>)");
  const Link& link = robot.links[0];
  const Eigen::Isometry3d X = link.X_PL(0);
  EXPECT_LE((X.translation() - Vector3d(.75, 2.5, 3)).norm(), 1e-14);
  EXPECT_LE((X.linear().col(0) - Vector3d::UnitY()).norm(), 1e-14);
  EXPECT_LE((link.X_PF.linear().col(2) - Vector3d::UnitY()).norm(), 1e-14);
  EXPECT_NEAR(link.X_PF.translation()[0], .75, 1e-14);
  EXPECT_NEAR(link.inertial.mass, 48, 1e-12);
  EXPECT_LE((link.inertial.first_moment - Vector3d(0, 0, -48)).norm(), 1e-12);
  EXPECT_LE(
      (link.inertial.inertia.diagonal() - Vector3d(.8 + 48, 1.6 + 48, 2.08))
          .norm(),
      1e-12);
}

// A frame gives what is in it a default class.
TEST(MjcfReader, FramesHaveClasses) {
  const Robot robot = Read(
      "<mujoco><default><default class='c'><joint damping='7'/></default>"
      "</default><worldbody><frame childclass='c'><body><joint/><geom "
      "size='1'/></body></frame></worldbody></mujoco>");
  EXPECT_EQ(robot.links[0].joint.viscous, 7);
}

// Moments that no body has become round, of the same sum.
TEST(MjcfReader, BalancesInertia) {
  const Robot robot = Read(
      "<mujoco><compiler balanceinertia='true'/><worldbody><body><joint/>"
      "<inertial pos='0 0 0' mass='1' diaginertia='1 2 6'/></body></worldbody>"
      "</mujoco>");
  EXPECT_LE((robot.links[0].inertial.inertia - 3 * Eigen::Matrix3d::Identity())
                .norm(),
            1e-14);
}

// As MuJoCo 4.0.0 compiles it: body "b" has no geom, and its 0.5 kg stand at
// the numbers of its `pos`.
TEST(MjcfReader, BoundsMassesOfEmptyBodies) {
  const Robot robot = Read(
      "<mujoco><compiler boundmass='.5' boundinertia='.1'/><worldbody>"
      "<body name='a'><joint/><inertial pos='0 0 0' mass='2' "
      "diaginertia='1 1 1'/><frame pos='10 0 0' euler='0 0 90'>"
      "<body name='b' pos='1 2 3' quat='1 1 0 0'/></frame></body></worldbody>"
      "</mujoco>");
  // The frame turns pos to -2 1 3, at 8 1 3; the body's y is z, its z is -y,
  // before: its numbers 1 2 3 are 1 -3 2 in the frame, and 3 1 2 in body "a".
  const Vector3d center(8 + 3, 1 + 1, 3 + 2);
  EXPECT_EQ(robot.links[0].inertial.mass, 2.5);
  EXPECT_LE((robot.links[0].inertial.first_moment - .5 * center).norm(), 1e-14);
}

// What MuJoCo makes bodies from is unknown, and matters on the chain alone.
TEST(MjcfReader, UnknownElementsOutsideTheChain) {
  const std::string text =
      "<mujoco><worldbody><composite/><body name='a'><joint/><geom size='1'/>"
      "<body name='b'><joint/><attach/></body></body></worldbody></mujoco>";
  RobotReaderOptions options;
  options.tip = "a";
  EXPECT_THAT(Read(text, options).notes,
              testing::IsSupersetOf(
                  {HasSubstr("<composite>: found 'composite'"),
                   HasSubstr("<attach> of body 'b': found 'attach'")}));
  options.tip = "b";
  EXPECT_THAT(MessageOf<InputError>("", [&] { Read(text, options); }),
              HasSubstr("<attach> of body 'b': found 'attach'"));
}

// The joint that an equality moves does not move by itself.
TEST(MjcfReader, CoupledJoints) {
  std::string text = kArm;
  text.insert(text.find("</mujoco>"),
              "<equality><joint joint1='elbow' joint2='shoulder'/></equality>");
  EXPECT_THAT(MessageOf<InputError>("", [&] { Read(text); }),
              HasSubstr("expected joints that move on their own"));
}

}  // namespace armcal::mjcf_reader_test
