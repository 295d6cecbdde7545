#include "model/robot_tree/chosen_joints.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/fixtures/urdf_text.h"

namespace armcal::chosen_joints_test {

using namespace urdf_text;

using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::ElementsAre;

// world -f- base -j1- a -f- a2 -j2- b -f- tool; finger moves beside b.
std::string Branched() {
  return LinkXml("world") + LinkXml("base") + LinkXml("a") + LinkXml("a2") +
         LinkXml("b") + LinkXml("tool") + LinkXml("finger") + LinkXml("nail") +
         JointXml("w", "fixed", "world", "base",
                  "<origin xyz='0 0 1' rpy='1.5707963267948966 0 0'/>") +
         JointXml("j1", "continuous", "base", "a", "<axis xyz='0 0 1'/>") +
         JointXml("f1", "fixed", "a", "a2", "<origin xyz='0 0.5 0'/>") +
         JointXml("j2", "continuous", "a2", "b",
                  "<origin xyz='0.25 0 0'/><axis xyz='0 0 1'/>") +
         JointXml("f2", "fixed", "b", "tool", "<origin xyz='0 0 0.125'/>") +
         JointXml("g", "prismatic", "a2", "finger",
                  "<mimic joint='j1'/><limit lower='0' upper='1'/>") +
         JointXml("n", "fixed", "finger", "nail") +
         "<transmission name='t'><joint name='j1'/></transmission><gazebo/>";
}

TEST(ChosenJoints, ChoosesAChain) {
  RobotReaderOptions options;
  options.tip = "b";
  Robot robot = Read(Branched(), options);
  EXPECT_THAT(robot.JointNames(), ElementsAre("j1", "j2"));
  EXPECT_EQ(robot.tool_name, "");
  EXPECT_TRUE(robot.gravity.isApprox(Vector3d(0, 0, -9.81), 0));
  EXPECT_TRUE(robot.links[0].X_PF.translation().isApprox(Vector3d(0, 0, 1)));
  EXPECT_TRUE(
      robot.links[1].X_PF.translation().isApprox(Vector3d(0.25, 0.5, 0)));
  EXPECT_THAT(
      robot.notes,
      ElementsAre("lumped into link 'a' by fixed joints: a2",
                  "lumped into link 'a' by joints that are held: finger, nail",
                  "lumped into link 'b' by fixed joints: tool",
                  "joints held still, with what they move (`posture`): g at 0 "
                  "m"));
  options.tip = "tool";
  robot = Read(Branched(), options);
  EXPECT_EQ(robot.tool_name, "tool");
  EXPECT_TRUE(robot.X_LT.translation().isApprox(Vector3d(0, 0, 0.125)));
  options.tip = "a2";  // what moves beyond the tip is held
  robot = Read(Branched(), options);
  EXPECT_THAT(robot.JointNames(), ElementsAre("j1"));
  EXPECT_EQ(robot.tool_name, "a2");
  EXPECT_EQ(robot.notes.size(), 3u);
}

TEST(ChosenJoints, GravityIsInTheBaseLinksFrame) {
  RobotReaderOptions options;
  options.tip = "tool";
  options.base = "base";  // its y points up
  Robot robot = Read(Branched(), options);
  EXPECT_TRUE(robot.gravity.isApprox(Vector3d(0, -9.81, 0), 1e-14));
  EXPECT_THAT(robot.notes.back(),
              testing::HasSubstr("gravity in the base link's frame is"));
  options.gravity = Vector3d(1, 2, 3);
  EXPECT_EQ(Read(Branched(), options).gravity, Vector3d(1, 2, 3));
  options.gravity.reset();
  options.base = "a";
  robot = Read(Branched(), options);
  EXPECT_THAT(robot.JointNames(), ElementsAre("j2"));
  EXPECT_EQ(robot.gravity, Vector3d(0, 0, -9.81));
  EXPECT_EQ(robot.notes.back(),
            "gravity is taken as 0 0 -9.81 m/s^2 in the base link's frame, "
            "which joint 'j1' "
            "moves");
  options.base = "base";
  EXPECT_THAT(Read(LinkXml("box") + Branched(), options).JointNames(),
              ElementsAre("j1", "j2"));
}

class ChosenJointsRefusal : public testing::TestWithParam<Case> {};

TEST_P(ChosenJointsRefusal, SaysWhereAndWhy) {
  EXPECT_EQ(Refusal(GetParam()), GetParam().message);
}

#define NAMES "expected one of the links base, upper, fore"

INSTANTIATE_TEST_SUITE_P(
    Chains, ChosenJointsRefusal,
    testing::Values(
        Case{"<link name=\"fore\"/>",
             "<link name=\"fore\"/><link name=\"box\"/>",
             "found 'base, box': expected one root link: choose one with "
             "`base`"},
        Case{"revolute", "floating",
             "line 11, joint 'shoulder': found 'floating': expected a "
             "revolute, continuous, prismatic or fixed joint in the chain; "
             "`base`=upper starts behind it"},
        Case{"continuous", "planar",
             "line 20, joint 'elbow': found 'planar': expected a revolute, "
             "continuous, prismatic or fixed joint in the chain; `base`=fore "
             "starts behind it"},
        Case{"<origin xyz=\"0.4 0 0\"/>", "<mimic joint=\"shoulder\"/>",
             "line 20, <mimic> of joint 'elbow': found 'elbow': expected "
             "joints that move on their own in the chain: armcal's arms are "
             "open chains; `tip`=upper ends it before them, and where the real "
             "robot has no such part, take it out of the file"},
        Case{"<link name=\"fore\"/>",
             "<link name=\"fore\"/><link name=\"finger\"/>"
             "<joint name=\"grip\" type=\"prismatic\"><parent link=\"upper\"/>"
             "<child link=\"finger\"/></joint>",
             "found 'finger, fore': expected one chain: choose its last link "
             "with `tip`, or several, as in `tip`=finger,fore; what other "
             "joints move counts as held still (`posture`). It branches at "
             "'upper': `tip`=upper has the joint that all share"}));

// A torso with two arms, the left one with a finger and a thumb; links of 1 kg
// with their centre 0.1 m along x.
std::string TwoArms() {
  const auto joint = [](const std::string& name, const std::string& parent,
                        const std::string& child) {
    return RodJointXml(name, parent, child, ".2 0 .1");
  };
  return LinkXml("base") + RodXml("torso") + RodXml("left") + RodXml("hand") +
         RodXml("right") + RodXml("palm") + RodXml("finger") + RodXml("thumb") +
         joint("t", "base", "torso") + joint("l1", "torso", "left") +
         joint("l2", "left", "hand") + joint("r1", "torso", "right") +
         joint("r2", "right", "palm") +
         JointXml("f", "revolute", "hand", "finger",
                  "<origin xyz='.3 0 0'/><axis xyz='0 0 1'/>"
                  "<limit lower='.1' upper='1.8' effort='1' velocity='1'/>") +
         JointXml("m", "revolute", "hand", "thumb",
                  "<origin xyz='.3 0 0'/><axis xyz='0 0 1'/><mimic joint='f' "
                  "multiplier='-2' offset='.5'/>"
                  "<limit lower='-4' upper='4' effort='1' velocity='1'/>");
}

TEST(ChosenJoints, SeveralTips) {
  RobotReaderOptions options;
  options.tip = "hand,palm";
  const Robot robot = Read(TwoArms(), options);
  EXPECT_THAT(robot.JointNames(), ElementsAre("t", "l1", "l2", "r1", "r2"));
  EXPECT_EQ(robot.parents, (LinkParents{-1, 0, 1, 0, 3}));
  EXPECT_EQ(robot.tool_name, "");
  options.tip = "palm,hand";
  EXPECT_THAT(Read(TwoArms(), options).JointNames(),
              ElementsAre("t", "r1", "r2", "l1", "l2"));
  // A tip on the way to another adds nothing; what branches where it began is
  // listed with it.
  options.tip = "left,palm,hand";
  EXPECT_THAT(Read(TwoArms(), options).JointNames(),
              ElementsAre("t", "l1", "l2", "r1", "r2"));
  options.tip = "left,hand";
  EXPECT_TRUE(Read(TwoArms(), options).parents.empty());
  options.tip = "hand,nobody";
  EXPECT_THAT(Refusal("<robot>" + TwoArms() + "</robot>", options),
              testing::HasSubstr("`tip`: found 'nobody': expected one of"));
}

// Beyond a joint that is held links count where they are then.
TEST(ChosenJoints, HeldJoints) {
  RobotReaderOptions options;
  options.tip = "hand";
  Robot robot = Read(TwoArms(), options);
  using Held = std::map<std::string, double>;
  // Next to 0 within the limits; the thumb follows the finger.
  EXPECT_EQ(robot.held,
            (Held{{"f", .1}, {"m", .5 - .2}, {"r1", 0}, {"r2", 0}}));
  EXPECT_EQ(robot.links[2].inertial.mass, 3);  // hand, finger, thumb
  EXPECT_EQ(robot.links[0].inertial.mass, 3);  // torso, right, palm
  options.posture = {{"f", M_PI_2}, {"r1", M_PI}};
  robot = Read(TwoArms(), options);
  EXPECT_EQ(robot.held,
            (Held{{"f", M_PI_2}, {"m", .5 - M_PI}, {"r1", M_PI}, {"r2", 0}}));
  // The finger points along y; the thumb to -pi + 0.5 from x.
  const Eigen::Vector3d hand =
      Vector3d(.1, 0, 0) + Vector3d(.3, .1, 0) +
      Vector3d(.3 + .1 * std::cos(.5 - M_PI), .1 * std::sin(.5 - M_PI), 0);
  EXPECT_TRUE(robot.links[2].inertial.first_moment.isApprox(hand, 1e-12));
  // The right arm is turned by pi about y, at (.2, 0, .1) of the torso.
  const Eigen::Vector3d torso = Vector3d(.1, 0, 0) + Vector3d(.2 - .1, 0, .1) +
                                Vector3d(.2 - .2 - .1, 0, .1 - .1);
  EXPECT_TRUE(robot.links[0].inertial.first_moment.isApprox(torso, 1e-12));
}

TEST(ChosenJoints, RefusesPosturesOfOtherJoints) {
  RobotReaderOptions options;
  options.tip = "hand,palm";
  const auto refusal = [&options](const std::string& joint, double q) {
    options.posture = {{joint, q}};
    return Refusal("<robot>" + TwoArms() + "</robot>", options);
  };
  EXPECT_EQ(refusal("l1", 0),
            "`posture`: found 'l1': expected a joint that moves something "
            "beside the robot's own: f, m");
  EXPECT_EQ(refusal("f", 2),
            "`posture`: found 'f=2': expected a position within the joint's "
            "limits, 0.1 to 1.8 rad");
  options.tip = "finger,thumb,palm";
  EXPECT_THAT(Refusal("<robot>" + TwoArms() + "</robot>", options),
              testing::HasSubstr("<mimic> of joint 'm'"));
}

// What is wrong outside the chain is no reason to refuse it.
TEST(ChosenJoints, WhatLiesOutsideIsNotedAlone) {
  const std::string wrong = LinkXml(
      "finger", Inertial("xyz='0 0 0' rpy='0 0 0'", "-1", "1", "1", "1"));
  const std::string arm =
      LinkXml("base") + LinkXml("a") + LinkXml("b") + wrong +
      JointXml("j1", "continuous", "base", "a") +
      JointXml("j2", "continuous", "a", "b") +
      JointXml("g", "prismatic", "b", "finger", "<axis xyz='0 0 0'/>");
  RobotReaderOptions options;
  options.tip = "b";
  const Robot robot = Read(arm, options);
  EXPECT_THAT(robot.JointNames(), ElementsAre("j1", "j2"));
  EXPECT_THAT(robot.notes,
              testing::IsSupersetOf(
                  {testing::ContainsRegex(
                       "not read, as it lies outside the chain: .*<mass value> "
                       "of link 'finger': found '-1'"),
                   testing::ContainsRegex(
                       "not read, as it lies outside the chain: .*<axis xyz> "
                       "of joint 'g': found '0 0 0'")}));
  EXPECT_THAT(Refusal("<robot>" + arm + "</robot>"),
              testing::HasSubstr("<axis xyz> of joint 'g'"));
}

// A fixed link whose place is unknown is part of the chain's links.
TEST(ChosenJoints, WhatIsFixedToTheChainHasToBeRead) {
  const auto arm = [](const std::string& parent) {
    return "<robot>" + LinkXml("base") + LinkXml("a") + LinkXml("cover") +
           JointXml("j1", "continuous", "base", "a") +
           JointXml("f", "fixed", parent, "cover", "<origin xyz='1 nan 0'/>") +
           "</robot>";
  };
  EXPECT_THAT(Refusal(arm("a")),
              testing::HasSubstr("<origin xyz> of joint 'f': found '1 nan 0'"));
  EXPECT_EQ(Refusal(arm("base")), "");
}

// Exporters write -5e-20 for 0.
TEST(ChosenJoints, RoundingOfMoments) {
  const auto refusal = [](const std::string& moment) {
    return Refusal("<robot>" + LinkXml("base") +
                   LinkXml("a", Inertial("xyz='0 0 0' rpy='0 0 0'", "2", moment,
                                         "1e-3", "1e-3")) +
                   JointXml("j1", "continuous", "base", "a") + "</robot>");
  };
  EXPECT_EQ(refusal("-5.42101e-20"), "");
  EXPECT_THAT(refusal("-1e-6"), testing::HasSubstr("that is not negative"));
}

// A massless link with moments, on a fixed joint, is part of the one with mass;
// alone it is no body.
TEST(ChosenJoints, MomentsWithoutMass) {
  const auto arm = [](const std::string& mass) {
    return LinkXml("base") +
           LinkXml("a",
                   Inertial("xyz='0 0 0' rpy='0 0 0'", mass, "1", "2", "2")) +
           LinkXml("b",
                   Inertial("xyz='5 0 0' rpy='0 0 0'", "0", ".1", ".1", ".1")) +
           JointXml("j1", "continuous", "base", "a") +
           JointXml("f", "fixed", "a", "b");
  };
  const Robot robot = Read(arm("3"));
  EXPECT_EQ(robot.links[0].inertial.mass, 3);
  EXPECT_EQ(robot.links[0].inertial.inertia(0, 0), 1.1);
  EXPECT_FALSE(Read(arm("0")).links[0].has_inertial);
}

TEST(ChosenJoints, BaseAndTip) {
  const auto refusal = [](const std::string& base, const std::string& tip) {
    RobotReaderOptions options;
    options.base = base;
    options.tip = tip;
    return Refusal(kArm, options);
  };
  EXPECT_EQ(refusal("world", ""), "`base`: found 'world': " NAMES);
  EXPECT_EQ(refusal("", "hand"), "`tip`: found 'hand': " NAMES);
  EXPECT_EQ(refusal("fore", ""),
            "expected a joint that moves a link of base link 'fore'");
  EXPECT_EQ(refusal("fore", "upper"),
            "`tip`: found 'upper': expected a link that joints connect to the "
            "base link 'fore'");
  EXPECT_EQ(refusal("", "base"),
            "`tip`: found 'base': expected a link that a joint moves relative "
            "to 'base'");
}

TEST(ChosenJoints, LongChains) {
  const auto chain = [](int joints) {
    std::string text = "<robot><link name='l0'/>";
    for (int i = 1; i <= joints; ++i) {
      const std::string n = std::to_string(i), p = std::to_string(i - 1);
      text += "<link name='l" + n + "'/><joint name='j" + n +
              "' type='continuous'><parent link='l" + p + "'/><child link='l" +
              n + "'/></joint>";
    }
    return text + "</robot>";
  };
  EXPECT_EQ(Refusal(chain(64)), "");
  EXPECT_EQ(Refusal(chain(65)),
            "found '65 joints': expected at most 64 moving joints in the "
            "chain");
  EXPECT_EQ(Refusal(chain(20000)),
            "found '20000 joints': expected at most 64 moving joints in the "
            "chain");
}

}  // namespace armcal::chosen_joints_test
