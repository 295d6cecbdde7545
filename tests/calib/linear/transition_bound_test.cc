#include "calib/linear/transition_bound.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/linear/calibration_report.h"
#include "tests/fixtures/calibrate_logs.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::transition_bound_test {

using testing::HasSubstr;

// A 2R arm whose second joint has friction 2 tanh(qd / width).
struct Arm {
  explicit Arm(double width)
      : robot(SampleRobot("2R planar (vertical plane)")) {
    std::mt19937_64 random(21);
    SetRandomInertials(&random, &robot);
    Log log = RecordMotion(RandomMultisine(&random, 2, .5), 20, .002);
    AddTorque(robot, &log);
    AddCoulomb(0, 2, {CoulombTransition::Law::kVelocity, .02}, &log);
    AddCoulomb(1, 2, {CoulombTransition::Law::kVelocity, width}, &log);
    logs = {log};
  }
  LinearCalibration Calibrate() const {
    return CalibrateLogs(robot, logs, options);
  }
  Robot robot;
  std::vector<Log> logs;
  LinearCalibrationOptions options;
};

TEST(TransitionBound, IsWarnedAbout) {
  const Arm arm(1.);
  const LinearCalibration result = arm.Calibrate();
  const auto warnings = TransitionWarnings(arm.robot, result);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr(arm.robot.links[1].joint.name +
                                     ": Coulomb friction changes sign over 0.3 "
                                     "rad/s, the largest width"));
  EXPECT_EQ(ToJson(arm.robot, result)["warnings"][0], warnings[0]);
  EXPECT_THAT(EstimateText(arm.robot, result),
              HasSubstr("warning    " + warnings[0]));
}

TEST(TransitionBound, WidthsWithinTheGridAreNot) {
  const Arm arm(.1);
  const LinearCalibration result = arm.Calibrate();
  EXPECT_TRUE(TransitionWarnings(arm.robot, result).empty());
  EXPECT_TRUE(ToJson(arm.robot, result)["warnings"].empty());
}

TEST(TransitionBound, NorAreThoseGiven) {
  Arm arm(1.);
  arm.options.transition =
      CoulombTransition{CoulombTransition::Law::kVelocity, .3};
  EXPECT_TRUE(TransitionWarnings(arm.robot, arm.Calibrate()).empty());
}

}  // namespace armcal::transition_bound_test
