#include <gtest/gtest.h>

#include <vector>

#include "model/effects/effects.h"
#include "tests/fixtures/effect_plant.h"
#include "tests/model/effects/hidden_truth.h"

namespace armcal::torque_saturation_test {

// Limits that are tried where a joint's torque is at most `top`, N m, and 10
// N m as a rule.
std::vector<double> Limits(double top, double usual = 10) {
  Robot robot;
  robot.links.resize(1);
  MotionScale scale;
  scale.torque = Eigen::VectorXd::Constant(1, usual);
  scale.top_torque = Eigen::VectorXd::Constant(1, top);
  return FindEffect("torque_saturation")
      ->parameters[1]
      .grid({&robot, 0, &scale});
}

// One that is never reached at usual speed is, at others; and its corner is
// felt before it is reached.
TEST(TorqueSaturation, IsLookedForUpToTwiceWhatWasAskedFor) {
  const std::vector<double> limits = Limits(20);
  EXPECT_NEAR(limits.front(), 10, 1e-9);
  EXPECT_NEAR(limits.back(), 40, 1e-9);
}

// A loop that winds up asks for ten times what it gets.
TEST(TorqueSaturation, IsLookedForDownToUsualTorque) {
  const std::vector<double> limits = Limits(200);
  EXPECT_NEAR(limits.front(), 15, 1e-9);
  EXPECT_NEAR(limits.back(), 400, 1e-9);
  for (size_t k = 1; k < limits.size(); ++k) {
    EXPECT_LT(limits[k], 1.26 * limits[k - 1]);
  }
}

// A robot file has the limit at rest and its fall, of what is a limit; what
// takes a twentieth of the excess is none at all.
TEST(TorqueSaturation, IsALimitOfADriveByItsShare) {
  Robot robot;
  robot.links.resize(1);
  MotionScale scale;
  scale.torque = scale.top_torque = Eigen::VectorXd::Constant(1, 10);
  scale.speed = Eigen::VectorXd::Constant(1, 2);
  const EffectSite site = {&robot, 0, &scale};
  const Effect& effect = *FindEffect("torque_saturation");
  const auto drive_of = [&](double share, double fall, JointDrive* drive) {
    const Eigen::Vector4d p(share, 8, .05, fall);
    return effect.set_drive(effect.numbers(site, p), drive);
  };
  JointDrive drive, flat;
  EXPECT_TRUE(drive_of(1, .5, &drive));
  EXPECT_NEAR(drive.torque_limit, 12, 1e-12);
  EXPECT_NEAR(drive.torque_limit_slope, 2, 1e-12);
  EXPECT_TRUE(drive_of(1, .01, &flat));
  EXPECT_NEAR(flat.torque_limit, 8.08, 1e-12);
  EXPECT_EQ(flat.torque_limit_slope, 0);
  EXPECT_FALSE(drive_of(.3, .5, &drive));
  const auto is_plausible = [&](double share) {
    return effect.plausible(
        site, EstimatesOf(effect, site, Eigen::Vector4d(share, 8, .05, .5)));
  };
  EXPECT_TRUE(is_plausible(.3));
  EXPECT_FALSE(is_plausible(.05));
  EXPECT_FALSE(is_plausible(5));
}

// Whether a limit, N m at usual speed, is one of a joint that asks for up to 50
// N m, 40 as a rule, at up to 2 rad/s.
bool IsPlausible(double limit, double knee, double fall) {
  Robot robot;
  robot.links.resize(1);
  MotionScale scale;
  scale.torque = Eigen::VectorXd::Constant(1, 40);
  scale.top_torque = Eigen::VectorXd::Constant(1, 50);
  scale.speed = Eigen::VectorXd::Constant(1, 1);
  scale.top_speed = Eigen::VectorXd::Constant(1, 2);
  const EffectSite site = {&robot, 0, &scale};
  const Effect& effect = *FindEffect("torque_saturation");
  return effect.plausible(
      site, EstimatesOf(effect, site, Eigen::Vector4d(1, limit, knee, fall)));
}

// A corner of .08 spans a quarter of the limit, and is felt by 50 N m below 55,
// not below 90; one of .02 is not. A limit that falls is at 45 N m where the
// joint is fastest.
TEST(TorqueSaturation, IsNoneWhereItIsNotReached) {
  EXPECT_TRUE(IsPlausible(55, .08, 0));
  EXPECT_FALSE(IsPlausible(90, .08, 0));
  EXPECT_FALSE(IsPlausible(55, .02, 0));
  EXPECT_TRUE(IsPlausible(90, .02, .5));
  EXPECT_FALSE(IsPlausible(200, .02, .5));
}

// A loop that winds up asks for more than its limit most of the time: that of a
// simulated arm, 82 N m as a rule where 64 are to be had.
TEST(TorqueSaturation, MayBeExceededByMostOfWhatIsAskedFor) {
  EXPECT_TRUE(IsPlausible(30, .05, 0));
}

TEST(TorqueSaturation, OfNoTorqueHasSomeLimit) {
  for (const double limit : Limits(0, 0)) EXPECT_GT(limit, 0);
}

// A supply's voltage, hidden by a law of its own: of limits and of shares by
// which they fall, those that leave least are the hidden ones.
TEST(TorqueSaturation, FallsWithSpeedAsTheHiddenOne) {
  const EffectPlant plant(12);
  const Effect& effect = *FindEffect("torque_saturation");
  constexpr int kJoint = 1;
  for (const double fall : {0., .3}) {
    SimulatedRobot robot = plant.Bare();
    auto truth = HideEffect(effect.name, kJoint, plant.arm().robot, 12, &robot,
                            {1.1, fall});
    const Log log = plant.Run(robot);
    RecordedTorque recorded(plant.arm().robot, plant.arm().transitions,
                            EffectPlant::MotionOf(log));
    const Eigen::MatrixXd measured = plant.Measured(log);
    std::map<std::string, double> found;
    double least = 1;
    for (double limit = .6; limit < 2; limit += .05) {
      for (double tried = 0; tried < .7; tried += .1) {
        Eigen::VectorXd p(4);
        p << 1, limit * plant.arm().scale.torque[kJoint], .05, tried;
        const Eigen::MatrixXd change = EffectPlant::Judged(
            plant.arm().Change(effect, kJoint, p, &recorded));
        const double left = (measured - change).norm() / measured.norm();
        if (left >= least) continue;
        least = left;
        for (const EffectEstimate& estimate :
             EstimatesOf(effect, plant.arm().Site(kJoint), p)) {
          found[estimate.name] = estimate.value;
        }
      }
    }
    EXPECT_LT(least, .01);
    EXPECT_NEAR(found["limit"], truth["limit"], .1 * truth["limit"]);
    EXPECT_NEAR(found["limit_slope"], truth["limit_slope"],
                .2 * truth["limit_slope"] + .01 * truth["limit"]);
  }
}

}  // namespace armcal::torque_saturation_test
