#include "calib/refine/impossible_robot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/calibrate.h"
#include "calib/calibration_details.h"
#include "tests/fixtures/inspected_arm.h"

namespace armcal::impossible_robot_test {

using testing::HasSubstr;

std::string Said(const InspectedArm& arm, const Log& log,
                 const ArmTrust& trust) {
  CalibrateOptions options;
  options.trust = trust;
  const CalibrateSummary summary =
      Calibrate(arm.robot, {{LogSource("log.csv", log)}, {}}, options);
  return WhatNoRobotExplains(*summary.details->linear,
                             *summary.details->refined, trust);
}

TEST(ImpossibleRobotTest, NothingIsSaidOfARobotThatExists) {
  const InspectedArm arm("3R elbow");
  EXPECT_EQ(Said(arm, arm.log, {}), "");
}

// Masses and friction of the linear model are those of the arm, negated.
TEST(ImpossibleRobotTest, ATorqueThatIsNegatedIsNoRobots) {
  const InspectedArm arm("3R elbow");
  Log negated = arm.log;
  negated.tau *= -1;
  EXPECT_THAT(Said(arm, negated, {}), HasSubstr("no robot that can exist"));
  // A file that is trusted more may be what holds the robot off.
  ArmTrust trust;
  trust.inertia = .01;
  EXPECT_EQ(Said(arm, negated, trust), "");
}

// The linear model takes up a friction that no law has by parameters that are a
// little impossible; as a share of what is left anyway, that is no sign.
TEST(ImpossibleRobotTest, WhatTheModelLacksIsNoSign) {
  const InspectedArm arm("3R elbow");
  Log rippled = arm.log;
  rippled.tau.array() += 5 * (7 * arm.log.q.array()).sin();
  EXPECT_EQ(Said(arm, rippled, {}), "");
}

}  // namespace armcal::impossible_robot_test
