#include "model/robot_files/mjcf_saturation.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "model/robot/saturating_parts.h"
#include "model/robot_files/robot_reader.h"
#include "tests/fixtures/temp_file.h"
#include "tests/fixtures/written_mjcf.h"

namespace armcal::mjcf_saturation_test {

using testing::Contains;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using tinyxml2::XMLElement;

Robot ReadBack(const WrittenMjcf& written) {
  return ReadRobot(WriteFile(written.text(), "saturation.xml"), {});
}

// Where friction falls a motor without a gain pushes; it comes back as the
// friction of a joint that moves fast, which is all that armcal's robots have.
TEST(MjcfSaturation, FrictionThatFallsIsAPush) {
  RobotDescription arm = ArmForMjcf();
  arm.drives[0].dry = {{1, .002}, {4, .01}, {-1.5, .5}, {-.5, 2}};
  const WrittenMjcf written(arm);
  const XMLElement* push = written.Named("general", "joint1_push");
  EXPECT_THAT(Numbers(push, "gainprm"), ElementsAre(0));
  EXPECT_THAT(Numbers(push, "biasprm"), ElementsAre(0, DoubleNear(0, 1e-8), 3));
  // Else MuJoCo would take the third for a damping ratio.
  EXPECT_NE(Numbers(push, "biasprm")[1], 0);
  EXPECT_THAT(Numbers(push, "forcerange"), ElementsAre(-1.5, 1.5));
  EXPECT_THAT(Numbers(written.Named("general", "joint1_push2"), "forcerange"),
              ElementsAre(-.5, .5));
  EXPECT_THAT(Numbers(written.Named("joint", "joint1"), "frictionloss"),
              ElementsAre(4));
  // Motors come first and keep their numbers.
  const XMLElement* first = written.All("actuator")[0]->FirstChildElement();
  EXPECT_STREQ(first->Name(), "motor");
  EXPECT_STREQ(first->NextSiblingElement()->Name(), "motor");
  EXPECT_THAT(MjcfFormat().more_losses(arm), IsEmpty());

  arm.robot.links[0].joint.effort = 80;
  const Robot robot = ReadBack(WrittenMjcf(arm));
  EXPECT_EQ(robot.links[0].joint.coulomb, 3);
  EXPECT_EQ(robot.links[0].joint.effort, 80);
  EXPECT_EQ(robot.links[0].joint.offset, 0);
  EXPECT_THAT(robot.notes, Contains(HasSubstr("pushes along the velocity")));
}

// One tendon has the springs' stiffness, and each of the others takes that of a
// part away beyond its width.
TEST(MjcfSaturation, ABoundedSpringIsLessItselfBeyondDeadBands) {
  RobotDescription arm = ArmForMjcf();
  arm.drives[1].bounded_springs = {{.5, {{2, .25}, {1, 1}}}};
  const WrittenMjcf written(arm);
  const std::vector<const XMLElement*> tendons = written.All("fixed");
  ASSERT_EQ(tendons.size(), 3);
  EXPECT_STREQ(tendons[0]->Attribute("name"), "joint2_band");
  EXPECT_STREQ(tendons[1]->Attribute("name"), "joint2_band2");
  EXPECT_THAT(Numbers(tendons[0], "stiffness"), ElementsAre(9));
  EXPECT_THAT(Numbers(tendons[0], "springlength"), ElementsAre(.5, .5));
  EXPECT_THAT(Numbers(tendons[1], "stiffness"), ElementsAre(-8));
  EXPECT_THAT(Numbers(tendons[1], "springlength"), ElementsAre(.25, .75));
  EXPECT_THAT(Numbers(tendons[2], "springlength"), ElementsAre(-.5, 1.5));
  EXPECT_THAT(MjcfFormat().more_losses(arm),
              ElementsAre(HasSubstr("2.3.1 or later")));
  const Robot robot = ReadBack(written);
  ASSERT_EQ(robot.num_joints(), 2);
  EXPECT_EQ(robot.links[1].joint.coulomb, 3);
  EXPECT_THAT(robot.notes, Contains(HasSubstr("joint2_band")));
}

// By MuJoCo's own words of `springlength`: no force between the two, beyond
// them a spring to the nearer one.
TEST(MjcfSaturation, TendonsAreTheCurveThatWasMeant) {
  RobotDescription arm = ArmForMjcf();
  arm.drives[0].bounded_springs = {TanhSpring(3, .4, .25)};
  const WrittenMjcf written(arm);
  const std::vector<const XMLElement*> tendons = written.All("fixed");
  for (double q = -4; q < 4; q += .07) {
    double force = 0;
    for (const XMLElement* tendon : tendons) {
      const auto ends = Numbers(tendon, "springlength");
      const double rest = std::clamp(q, ends[0], ends[1]);
      force -= Numbers(tendon, "stiffness")[0] * (q - rest);
    }
    EXPECT_NEAR(force, -3 * std::tanh((q - .4) / .25), .03) << q;
  }
}

// -1 -1 would be a length that MuJoCo works out.
TEST(MjcfSaturation, ACentreIsNeverMinusOne) {
  RobotDescription arm = ArmForMjcf();
  arm.drives[0].bounded_springs = {{-1, {{2, .25}}}};
  const auto at = Numbers(WrittenMjcf(arm).All("fixed")[0], "springlength");
  EXPECT_GT(at[0], -1);
  EXPECT_NEAR(at[0], -1, 1e-12);
}

// Parts that push make the curve less steep where they have not saturated.
TEST(MjcfSaturation, TheSteepestSlopeIsOfAllPartsBehindIt) {
  EXPECT_DOUBLE_EQ(SteepestSlope({{1, .5}, {2, .1}, {-1, 1}}), 2 - 1 + 20);
  EXPECT_DOUBLE_EQ(SteepestSlope({{-1, .1}, {2, 1}}), 2);
  EXPECT_EQ(SteepestSlope({}), 0);
}

}  // namespace armcal::mjcf_saturation_test
