#include "calib/diagnose/judge/dissipation.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "model/effects/effects.h"
#include "model/signals/delayed_signal.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::dissipation_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Whether the one effect that is considered, and found in a log of 30 s, takes
// power that friction would have to give. Torques are late by `delay`, s, and
// viscous friction of the first joint is this; the file says .8.
bool AsksForPower(const std::string& only, double viscous, double delay,
                  bool with_reference) {
  const EffectArm arm("2R planar (vertical plane)", 30, .005);
  const GapBaseline baseline(arm.robot, {}, VectorXd::Constant(2, 10));
  std::mt19937_64 random(2);
  const auto record = [&](const Robot& robot, double late) {
    MatrixXd tau = Delayed(
        RecordedTorque(robot, baseline.transitions(), arm.motion).nominal(),
        late / arm.motion.dt);
    AddNoise(&random, VectorXd::Constant(2, .05), &tau);
    return MakeSegment(arm.motion, tau);
  };
  Robot robot = arm.robot;
  robot.links[0].joint.viscous = viscous;
  GapFitOptions options;
  options.bandwidth_hz = 6;
  for (const Effect& effect : Effects()) {
    if (effect.name != only) options.without.push_back(effect.name);
  }
  std::vector<GapSegment> reference;
  if (with_reference) reference.push_back(record(robot, 0));
  GapFit fit(baseline, options, {record(robot, delay)}, reference);
  fit.Choose();
  EXPECT_EQ(fit.refined().effects.size(), 1u);
  return MakesFrictionGivePower(fit, 0);
}

constexpr double kDelay = .06;  // s

TEST(DissipationTest, AJointThatTakesPowerIsAnArms) {
  EXPECT_FALSE(AsksForPower("delay", .8, kDelay, false));
  EXPECT_FALSE(AsksForPower("delay", .05, kDelay, false));
}

// Without the delay friction would be above 0: the torque that is late holds
// back what moves.
TEST(DissipationTest, AJointThatGivesPowerIsNot) {
  EXPECT_TRUE(AsksForPower("delay", -.4, kDelay, false));
}

// A change of friction is one as long as friction is left.
TEST(DissipationTest, FrictionIsNoLessThanNone) {
  EXPECT_FALSE(AsksForPower("viscous_friction", .2, 0, false));
  EXPECT_TRUE(AsksForPower("viscous_friction", -.4, 0, false));
}

// The reference's own laws may hold a part of friction.
TEST(DissipationTest, SinceAReferenceNothingIsAsked) {
  EXPECT_FALSE(AsksForPower("delay", -.2, kDelay, true));
}

}  // namespace armcal::dissipation_test
