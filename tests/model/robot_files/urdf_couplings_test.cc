#include "model/robot_files/urdf_couplings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/fixtures/urdf_text.h"

namespace armcal::urdf_couplings_test {

using namespace urdf_text;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

// base -j1- a -j2- b -j3- c; j4 moves d beside b.
std::string Arm(const std::string& of_j4, const std::string& of_d,
                const std::string& more = "") {
  return LinkXml("base") + LinkXml("a") + LinkXml("b") + LinkXml("c") +
         LinkXml("d", of_d) + JointXml("j1", "continuous", "base", "a") +
         JointXml("j2", "continuous", "a", "b") +
         JointXml("j3", "continuous", "b", "c") +
         JointXml("j4", "continuous", "b", "d", of_j4) + more;
}

std::string RefusalOfTip(const std::string& text, const std::string& tip) {
  RobotReaderOptions options;
  options.tip = tip;
  return Refusal("<robot>" + text + "</robot>", options);
}

const std::string kBody =
    Inertial("xyz='0 0 0' rpy='0 0 0'", "1", "1", "1", "1");

// The follower's inertia is in the torque of the joint that it follows.
TEST(UrdfCouplings, Mimic) {
  const std::string arm = Arm("<mimic joint='j2'/>", kBody);
  EXPECT_EQ(RefusalOfTip(arm, "d"),
            "line 1, <mimic> of joint 'j4': found 'j2, j4': expected joints "
            "that move on their own in the chain: armcal's arms are open "
            "chains; `tip`=a ends it before them, and where the real robot has "
            "no such part, take it out of the file");
  EXPECT_THAT(RefusalOfTip(arm, "c"), HasSubstr("found 'j2': "));
  EXPECT_EQ(RefusalOfTip(arm, "a"), "");
  EXPECT_EQ(RefusalOfTip(Arm("<mimic joint='j2'/>", ""), "c"), "");
}

TEST(UrdfCouplings, LoopsThatUrdfItselfHasNot) {
  for (const std::string loop :
       {"<gazebo><joint name='rod' type='revolute'><parent> base </parent>"
        "<child>b</child></joint></gazebo>",
        "<gazebo><joint name='rod'><parent>world</parent><child>b</child>"
        "</joint></gazebo>",
        "<loop_joint name='rod' type='spherical'><link1 link='b'/>"
        "<link2 link='base'/></loop_joint>"}) {
    EXPECT_THAT(RefusalOfTip(Arm("", kBody, loop), "c"),
                testing::AllOf(HasSubstr("> 'rod', which closes a loop from "),
                               HasSubstr("found 'j1, j2': "),
                               HasSubstr("`base`=b starts it behind them")))
        << loop;
  }
  const std::string beside =
      "<loop_joint name='rod'><link1 link='c'/><link2 link='d'/></loop_joint>";
  EXPECT_THAT(RefusalOfTip(Arm("", kBody, beside), "c"), HasSubstr("'j3'"));
  RobotReaderOptions options;
  options.tip = "b";
  const Robot robot = Read(Arm("", kBody, beside), options);
  EXPECT_THAT(robot.JointNames(), ElementsAre("j1", "j2"));
  EXPECT_THAT(robot.notes,
              Contains(HasSubstr("not used, as it lies outside the chain: line "
                                 "1, <loop_joint> 'rod'")));
  EXPECT_THAT(RefusalOfTip(Arm("", "",
                               "<loop_joint><link1 link='x'/>"
                               "<link2 link='c'/></loop_joint>"),
                           "c"),
              HasSubstr("<link1>: found 'x': expected one of the links"));
}

}  // namespace armcal::urdf_couplings_test
