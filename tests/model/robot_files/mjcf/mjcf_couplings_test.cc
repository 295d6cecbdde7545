#include "model/robot_files/mjcf/mjcf_couplings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "model/robot_files/mjcf/mjcf_reader.h"
#include "model/text/input_error.h"

namespace armcal::mjcf_couplings_test {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

// base - upper - lower - hand with two fingers, and a rod on the base.
std::string Arm(const std::string& sections) {
  const auto body = [](const std::string& name, const std::string& inner) {
    return "<body name='" + name + "'><joint name='j_" + name +
           "'/><geom size='1'/><site name='s_" + name + "'/>" + inner +
           "</body>";
  };
  return "<mujoco><worldbody><site name='s_world'/>" +
         body("upper", body("lower", body("hand", body("left", "") +
                                                      body("right", "")))) +
         body("rod", "") + "<body name='handle' mocap='true'/></worldbody>\n" +
         sections + "</mujoco>";
}

Robot Read(const std::string& sections, const std::string& tip = "hand",
           const std::string& base = "") {
  RobotReaderOptions options;
  options.tip = tip;
  options.base = base;
  return ReadMjcf({"arm.mjcf", Arm(sections)}, options);
}

std::string Refusal(const std::string& sections,
                    const std::string& tip = "hand",
                    const std::string& base = "") {
  try {
    Read(sections, tip, base);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

#define EQUALITY(TEXT) "<equality>" TEXT "</equality>"
#define OPEN                                                            \
  "expected joints that move on their own in the chain: armcal's arms " \
  "are open chains; "
#define NOT_REAL                                               \
  "and where the real robot has no such part, take it out of " \
  "the file"

TEST(MjcfCouplings, ALoopOverTheChainIsRefused) {
  const char rod[] = EQUALITY("<connect name='r' body1='rod' body2='hand'/>");
  EXPECT_EQ(Refusal(rod),
            "arm.mjcf: line 2, equality <connect> 'r', which closes a loop: "
            "found 'j_upper, j_lower, j_hand': " OPEN NOT_REAL);
  // The part of a loop that leaves the first joint alone.
  EXPECT_EQ(
      Refusal(EQUALITY("<weld site1='s_upper' site2='s_hand'/>"), "left"),
      "arm.mjcf: line 2, equality <weld>, which closes a loop: found 'j_lower, "
      "j_hand': " OPEN
      "`tip`=upper ends it before them, `base`=hand starts it behind "
      "them, " NOT_REAL);
  EXPECT_THAT(Refusal(EQUALITY("<weld body1='lower'/>")),
              HasSubstr("found 'j_upper, j_lower'"));
  EXPECT_THAT(Read(EQUALITY("<weld body1='upper' body2='hand'/>"), "upper")
                  .JointNames(),
              ElementsAre("j_upper"));
}

TEST(MjcfCouplings, ALoopBesideTheChainIsNoted) {
  const Robot robot = Read(EQUALITY("<connect body1='left' body2='right'/>"));
  EXPECT_THAT(robot.JointNames(), ElementsAre("j_upper", "j_lower", "j_hand"));
  EXPECT_THAT(robot.notes,
              Contains("not used, as it lies outside the chain: line 2, "
                       "equality <connect>, which closes a loop"));
  EXPECT_THAT(
      Read(EQUALITY("<weld body1='upper'/>"), "left", "upper").JointNames(),
      ElementsAre("j_lower", "j_hand", "j_left"));
}

TEST(MjcfCouplings, WhatIsNotActiveOrNotOfTheRobot) {
  EXPECT_EQ(Refusal(EQUALITY("<weld body1='hand' active='false'/>")), "");
  EXPECT_EQ(Refusal("<default><equality active='false'/></default>" EQUALITY(
                "<weld body1='hand'/>")),
            "");
  EXPECT_THAT(Read(EQUALITY("<weld body1='handle' body2='hand'/>")).notes,
              Contains("not used, as it holds a body that only a simulation "
                       "moves (mocap): equality <weld>"));
}

// Both joints of an equality move together, whichever comes first.
TEST(MjcfCouplings, Joints) {
  for (const std::string pair :
       {"joint1='j_lower' joint2='j_rod'", "joint1='j_rod' joint2='j_lower'",
        "joint1='j_lower'"}) {
    EXPECT_THAT(Refusal("<equality><joint " + pair + "/></equality>"),
                HasSubstr("equality <joint>: found 'j_lower': " OPEN
                          "`tip`=upper ends it before them, `base`=lower"))
        << pair;
  }
  EXPECT_EQ(Refusal(EQUALITY("<joint joint1='j_left' joint2='j_right'/>")), "");
  EXPECT_THAT(
      Refusal(EQUALITY("<joint joint1='j_left' joint2='j_right'/>"), "left"),
      HasSubstr("found 'j_left'"));
}

#define FIXED(ATTRIBUTES)                                             \
  "<tendon><fixed name='t' " ATTRIBUTES                               \
  "><joint joint='j_lower' coef='1'/><joint joint='j_rod' coef='1'/>" \
  "</fixed></tendon>"

TEST(MjcfCouplings, TendonsThatActOnTheChain) {
  for (const auto& [text, how] :
       std::initializer_list<std::pair<std::string, std::string>>{
           {FIXED("stiffness='2'"), "stiffness"},
           {FIXED("damping='2'"), "damping"},
           {FIXED("frictionloss='2'"), "frictionloss"},
           {"<default><tendon stiffness='1'/></default>" FIXED(""),
            "stiffness"},
           {FIXED("") "<actuator><motor tendon='t'/></actuator>", "actuator"},
           {FIXED("") EQUALITY("<tendon tendon1='t'/>"), "equality"}}) {
    EXPECT_THAT(Refusal(text), HasSubstr("tendon <fixed> 't' with its " + how +
                                         ": found 'j_lower': " OPEN));
  }
  EXPECT_THAT(Read(FIXED("range='0 1'")).notes,
              Contains("not used: tendon <fixed> 't', which has no "
                       "stiffness, damping, friction or actuator"));
  // The same outside the chain.
  EXPECT_EQ(Refusal(FIXED("stiffness='2'"), "upper"), "");
}

// A cable from the world over the hand: it pulls on all joints between.
TEST(MjcfCouplings, SpatialTendons) {
  EXPECT_THAT(Refusal("<tendon><spatial stiffness='1'><site site='s_world'/>"
                      "<site site='s_hand'/></spatial></tendon>"),
              HasSubstr("found 'j_upper, j_lower, j_hand'"));
  // Two pieces of one cable, each within what moves together.
  EXPECT_EQ(Refusal("<tendon><spatial stiffness='1'><site site='s_left'/>"
                    "<site site='s_right'/><pulley divisor='2'/>"
                    "<site site='s_rod'/><site site='s_world'/></spatial>"
                    "</tendon>"),
            "");
}

TEST(MjcfCouplings, UnknownNames) {
  EXPECT_THAT(
      Refusal(EQUALITY("<connect body1='none'/>")),
      HasSubstr("line 2, <connect body1>: found 'none': expected a body "
                "of the file"));
  EXPECT_THAT(Refusal("<actuator><motor tendon='none'/></actuator>"),
              HasSubstr("found 'none': expected a tendon of the file"));
}

}  // namespace armcal::mjcf_couplings_test
