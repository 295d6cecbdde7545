// What a calibration of geometry is refused for, and what it only notes, by
// results that are made up.

#include "calib/poses/verdict.h"

#include <gmock/gmock.h>

#include <cmath>

#include "model/text/option_name.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::verdict_test {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr double kPrior = .01;  // m, and rad

// Twelve lengths and an angle, as in the file.
PoseCalibration AsInTheFile(const Robot& robot) {
  PoseCalibration c;
  c.solved = true;
  c.refined = true;
  c.count = 100;
  c.extent = 1;
  c.travel.setOnes(robot.num_joints());
  c.inlier_motion.setOnes(robot.num_joints());
  for (int k = 0; k < 12; ++k) {
    c.parameters.push_back(
        {"link" + std::to_string(k) + ".a", "m", .4, .4, 1e-5, kPrior, true});
  }
  c.parameters.push_back({"link1.theta", "rad", 0, 0, 1e-5, kPrior, true});
  return c;
}

// Chi squared of twelve degrees of freedom is above 32.909 in one of a thousand
// cases (Pearson and Hartley 1966, table 8).
TEST(PoseVerdict, LengthsBeyondThePriorAreNoCalibration) {
  const Robot robot = SampleRobot("UR5 6R");
  PoseCalibration c = AsInTheFile(robot);
  EXPECT_THAT(Shortcomings(robot, c), IsEmpty());
  // A zero may be anywhere.
  c.parameters.back().value = 1;
  EXPECT_THAT(Shortcomings(robot, c), IsEmpty());
  const auto set = [&](int k, double squares) {
    c.parameters[k].value = .4 - kPrior * std::sqrt(squares);
  };
  set(3, 16.8);
  set(5, 16.0);
  EXPECT_THAT(Shortcomings(robot, c), IsEmpty());
  set(5, 16.2);
  EXPECT_THAT(Shortcomings(robot, c),
              ElementsAre(AllOf(HasSubstr("link3.a by -40.99 mm (4.1 standard"),
                                HasSubstr(OptionName("length_trust")))));
  // Each that is too far by itself is named.
  set(5, 900);
  EXPECT_THAT(Shortcomings(robot, c),
              ElementsAre(HasSubstr("by: link5.a by -300 mm (30 standard")));
  // Not where no pose tells it.
  c.parameters[5].identifiable = false;
  EXPECT_THAT(Shortcomings(robot, c), IsEmpty());
}

TEST(PoseVerdict, JointsThatStandAtTheBaseAreHeld) {
  const Robot robot = SampleRobot("UR5 6R");
  PoseCalibration c = AsInTheFile(robot);
  EXPECT_THAT(PoseNotes(robot, c), IsEmpty());
  c.travel[0] = 0;
  EXPECT_THAT(Shortcomings(robot, c), IsEmpty());
  EXPECT_THAT(PoseNotes(robot, c),
              ElementsAre(AllOf(
                  StartsWith(robot.links[0].joint.name + " never moves: "),
                  HasSubstr(OptionName("base") + "=" + robot.links[0].name))));
  // Between joints that move nobody knows where one link ends.
  c.travel[3] = 0;
  EXPECT_THAT(
      Shortcomings(robot, c),
      ElementsAre(AllOf(StartsWith(robot.links[3].joint.name + " never moves"),
                        HasSubstr("measure poses in which it moves"))));
  // Its zero is one number.
  c.parameters.erase(c.parameters.begin(), c.parameters.end() - 1);
  EXPECT_THAT(Shortcomings(robot, c), IsEmpty());
}

TEST(PoseVerdict, AJointThatCountsTheOtherWayIsNoGear) {
  const Robot robot = SampleRobot("UR5 6R");
  PoseCalibration c = AsInTheFile(robot);
  c.coupling = PoseCoupling{2, 2, -2.001, .001, .3, 1e-4};
  EXPECT_THAT(Shortcomings(robot, c),
              Contains(HasSubstr(" counts the other way")));
  c.coupling->factor = -2.003;
  EXPECT_THAT(Shortcomings(robot, c), Contains(StartsWith("gear ratio: ")));
}

}  // namespace armcal::verdict_test
