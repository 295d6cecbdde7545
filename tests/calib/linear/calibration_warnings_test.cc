#include "calib/linear/calibration_warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/linear/calibration_report.h"
#include "tests/fixtures/calibrate_logs.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::calibration_warnings_test {

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
  const auto warnings = CalibrationWarnings(arm.robot, result);
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
  EXPECT_TRUE(CalibrationWarnings(arm.robot, result).empty());
  EXPECT_TRUE(ToJson(arm.robot, result)["warnings"].empty());
}

TEST(TransitionBound, NorAreThoseGiven) {
  Arm arm(1.);
  arm.options.transition =
      CoulombTransition{CoulombTransition::Law::kVelocity, .3};
  for (const auto& warning : CalibrationWarnings(arm.robot, arm.Calibrate())) {
    EXPECT_THAT(warning, testing::Not(HasSubstr("largest width")));
  }
}

// The same arm with white noise of the torque, and a log to hold out.
struct NoisyArm : Arm {
  NoisyArm() : Arm(.1) {
    AddNoise(&random, Eigen::Vector2d(.1, .1), &logs[0].tau);
  }
  LinearCalibration Validate(double coulomb_of_the_first) {
    Log other = RecordMotion(RandomMultisine(&random, 2, .5), 20, .002);
    AddTorque(robot, &other);
    AddCoulomb(0, coulomb_of_the_first,
               {CoulombTransition::Law::kVelocity, .02}, &other);
    AddCoulomb(1, 2, {CoulombTransition::Law::kVelocity, .1}, &other);
    AddNoise(&random, Eigen::Vector2d(.1, .1), &other.tau);
    return CalibrateLogs(robot, logs, options, false, {other});
  }
  std::mt19937_64 random{22};
};

TEST(HeldOut, IsWarnedAboutWhereFrictionIsAnother) {
  NoisyArm arm;
  const auto warnings = CalibrationWarnings(arm.robot, arm.Validate(3));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("held out, more than twice"));
  EXPECT_THAT(warnings[0], HasSubstr(arm.robot.links[0].joint.name));
  EXPECT_THAT(warnings[0],
              testing::Not(HasSubstr(arm.robot.links[1].joint.name + " (")));
}

TEST(HeldOut, IsNotOfTheSameRobot) {
  NoisyArm arm;
  EXPECT_TRUE(CalibrationWarnings(arm.robot, arm.Validate(2)).empty());
}

// Friction that changes sign at once: no width that the log resolves.
TEST(TransitionTable, AWidthThatNoSampleShowsIsBounded) {
  Arm arm(1e-7);
  const LinearCalibration result = arm.Calibrate();
  const std::string text = EstimateText(arm.robot, result);
  EXPECT_THAT(text, HasSubstr("less than ")) << text;
  EXPECT_THAT(text, testing::Not(HasSubstr("e-07")));
}

// Torques that hold less of a joint's own acceleration than its link has: the
// motion of the others tells the link's inertia by itself.
TEST(NegativeEstimates, AnArmatureBelowZeroIsWarnedAbout) {
  NoisyArm arm;
  Log& log = arm.logs[0];
  log.tau.col(1) -= .2 * log.qdd.col(1);
  const auto warnings = CalibrationWarnings(arm.robot, arm.Calibrate());
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("armature -0.198"));
  EXPECT_THAT(warnings[0], HasSubstr("below zero"));
}

// A linear fit has no bounds.
TEST(NegativeEstimates, OfTorquesThatAreNegatedAreWarnedAbout) {
  NoisyArm arm;
  EXPECT_TRUE(CalibrationWarnings(arm.robot, arm.Calibrate()).empty());
  arm.logs[0].tau *= -1;
  const auto warnings = CalibrationWarnings(arm.robot, arm.Calibrate());
  ASSERT_EQ(warnings.size(), 2u);
  for (int j = 0; j < 2; ++j) {
    const std::string& name = arm.robot.links[j].joint.name;
    EXPECT_THAT(warnings[j],
                testing::StartsWith(name + ": inertia (with arma"));
    EXPECT_THAT(warnings[j], HasSubstr("Coulomb friction -"));
    EXPECT_THAT(warnings[j], HasSubstr("has the wrong sign (armcal inspect)"));
  }
}

// Friction that grows with the speed's cube is, by a line over the speeds of a
// log, viscous friction less something of one size: below zero at rest, and yet
// it takes power.
TEST(NegativeEstimates, OfFrictionOfAnotherLawAreNoSign) {
  NoisyArm arm;
  const Eigen::ArrayXXd qd = arm.logs[0].qd.array();
  arm.logs[0].tau.array() += 60 * qd * qd.square();
  arm.options.transition =
      CoulombTransition{CoulombTransition::Law::kVelocity, .1};
  const auto warnings = CalibrationWarnings(arm.robot, arm.Calibrate());
  ASSERT_FALSE(warnings.empty());
  EXPECT_THAT(warnings[0], HasSubstr(": Coulomb friction -"));
  EXPECT_THAT(warnings[0], HasSubstr("no sign is wrong"));
}

// One wrong sample of a position costs nothing but a sentence.
TEST(PositionSpikes, AreWarnedAbout) {
  Arm arm(.02);
  const LinearCalibration clean = arm.Calibrate();
  arm.logs[0].q(2500, 1) += 1;
  const LinearCalibration result = arm.Calibrate();
  const auto warnings = CalibrationWarnings(arm.robot, result);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr(arm.robot.links[1].joint.name +
                                     ": 1 wrong sample of its position was"));
  EXPECT_LT(
      (result.x - clean.x).cwiseQuotient(clean.stddev).cwiseAbs().maxCoeff(),
      1);
}

// Rows in which a logger put no measurement are one sentence for all joints,
// and their torques are left out with them.
TEST(PositionSpikes, OfAllJointsAreOneSentence) {
  Arm arm(.02);
  const LinearCalibration clean = arm.Calibrate();
  for (const int row : {0, 2500}) {
    arm.logs[0].q.row(row).setConstant(-M_PI);
    arm.logs[0].tau.row(row).setZero();
  }
  const LinearCalibration result = arm.Calibrate();
  const auto warnings = CalibrationWarnings(arm.robot, result);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("2 wrong rows were left out, at which all "
                                     "joints leave their motion"));
  EXPECT_LT(
      (result.x - clean.x).cwiseQuotient(clean.stddev).cwiseAbs().maxCoeff(),
      1);
  EXPECT_EQ(result.identifiability.batch_rank,
            clean.identifiability.batch_rank);
}

}  // namespace armcal::calibration_warnings_test
