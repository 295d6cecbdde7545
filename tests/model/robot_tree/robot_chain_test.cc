#include "model/robot_tree/robot_chain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/fixtures/urdf_text.h"

namespace armcal::robot_chain_test {

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

TEST(RobotChain, ChoosesAChain) {
  RobotReaderOptions options;
  options.tip = "b";
  Robot robot = Read(Branched(), options);
  EXPECT_THAT(robot.JointNames(), ElementsAre("j1", "j2"));
  EXPECT_EQ(robot.tool_name, "");
  EXPECT_TRUE(robot.gravity.isApprox(Vector3d(0, 0, -9.81), 0));
  EXPECT_TRUE(robot.links[0].X_PF.translation().isApprox(Vector3d(0, 0, 1)));
  EXPECT_TRUE(
      robot.links[1].X_PF.translation().isApprox(Vector3d(0.25, 0.5, 0)));
  EXPECT_THAT(robot.notes,
              ElementsAre("lumped into link 'a' by fixed joints: a2",
                          "dropped, as joint 'g' moves them beside the chain: "
                          "finger, nail",
                          "lumped into link 'b' by fixed joints: tool",
                          "not used, as it lies outside the chain: line 1, "
                          "<mimic> of joint 'g'"));
  options.tip = "tool";
  robot = Read(Branched(), options);
  EXPECT_EQ(robot.tool_name, "tool");
  EXPECT_TRUE(robot.X_LT.translation().isApprox(Vector3d(0, 0, 0.125)));
  options.tip = "a2";  // what moves beyond the tip is dropped
  robot = Read(Branched(), options);
  EXPECT_THAT(robot.JointNames(), ElementsAre("j1"));
  EXPECT_EQ(robot.tool_name, "a2");
  EXPECT_EQ(robot.notes.size(), 4u);
}

TEST(RobotChain, GravityIsInTheBaseLinksFrame) {
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

class RobotChainRefusal : public testing::TestWithParam<Case> {};

TEST_P(RobotChainRefusal, SaysWhereAndWhy) {
  EXPECT_EQ(Refusal(GetParam()), GetParam().message);
}

#define NAMES "expected one of the links base, upper, fore"

INSTANTIATE_TEST_SUITE_P(
    Chains, RobotChainRefusal,
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
             "with `tip`; links that move beside the chain are left out. It "
             "branches at 'upper': `tip`=upper has the joint that all share"}));

// What is wrong outside the chain is no reason to refuse it.
TEST(RobotChain, WhatLiesOutsideIsNotedAlone) {
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
TEST(RobotChain, WhatIsFixedToTheChainHasToBeRead) {
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
TEST(RobotChain, RoundingOfMoments) {
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
TEST(RobotChain, MomentsWithoutMass) {
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

TEST(RobotChain, BaseAndTip) {
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

TEST(RobotChain, LongChains) {
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

}  // namespace armcal::robot_chain_test
