#include "calib/diagnose/judge/dissipation.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "model/effects/effects.h"
#include "model/signals/delayed_signal.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::dissipation_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Whether the delay that is found in a log of 30 s takes power that friction
// would have to give. Torques are late by 60 ms, and viscous friction of the
// first joint is this.
bool AsksForPower(double viscous, bool with_reference) {
  constexpr double kDelay = .06;  // s
  const EffectArm arm("2R planar (vertical plane)", 30, .005);
  const GapBaseline baseline(arm.robot, {}, VectorXd::Constant(2, 10));
  std::mt19937_64 random(2);
  const auto record = [&](const Robot& robot, double delay) {
    MatrixXd tau = Delayed(
        RecordedTorque(robot, baseline.transitions(), arm.motion).nominal(),
        delay / arm.motion.dt);
    AddNoise(&random, VectorXd::Constant(2, .05), &tau);
    return MakeSegment(arm.motion, tau);
  };
  Robot robot = arm.robot;
  robot.links[0].joint.viscous = viscous;
  GapFitOptions options;
  options.bandwidth_hz = 6;
  for (const Effect& effect : Effects()) {
    if (effect.name != "delay") options.without.push_back(effect.name);
  }
  std::vector<GapSegment> reference;
  if (with_reference) reference.push_back(record(robot, 0));
  GapFit fit(baseline, options, {record(robot, kDelay)}, reference);
  fit.Choose();
  EXPECT_EQ(fit.refined().effects.size(), 1u);
  return MakesFrictionGivePower(fit, 0);
}

TEST(DissipationTest, AJointThatTakesPowerIsAnArms) {
  EXPECT_FALSE(AsksForPower(.8, false));
  EXPECT_FALSE(AsksForPower(.05, false));
}

// Without the delay friction would be above 0: the torque that is late holds
// back what moves.
TEST(DissipationTest, AJointThatGivesPowerIsNot) {
  EXPECT_TRUE(AsksForPower(-.4, false));
}

// The reference's own laws may hold a part of friction.
TEST(DissipationTest, SinceAReferenceNothingIsAsked) {
  EXPECT_FALSE(AsksForPower(-.2, true));
}

}  // namespace armcal::dissipation_test
