#include "tests/blind/effect_size.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/blind/oracle_gap.h"

namespace armcal::effect_size_test {

BlindCase RichCase(const std::string& arm) {
  for (uint64_t seed = 0;; ++seed) {
    BlindCase blind = DrawBlindCase(seed, PlanCase(Stratum::kNoneRich, 0));
    if (blind.arm != arm || blind.points) continue;
    blind.has_reference = false;
    blind.training_s = 12;
    return blind;
  }
}

ChosenEffect Usual(const std::string& name, int joint) {
  const HiddenEffect* kind = FindHiddenEffect(name);
  return {kind, joint, UsualParameters(*kind)};
}

std::vector<EffectSize> Sizes(const BlindCase& blind) {
  const auto sizes = EffectSizes(blind);
  EXPECT_TRUE(sizes) << "the arm does not follow";
  return sizes.value_or(std::vector<EffectSize>(blind.effects.size()));
}

// A ripple of amplitude A that no parameter of the model looks like has an rms
// torque of A / sqrt(2). White noise of s at 250 Hz has a power of s^2 / 125
// per Hz, of which whitened samples at 25 Hz see 12.5 Hz.
TEST(EffectSize, OfARippleIsItsRmsOverTheNoise) {
  BlindCase blind = RichCase("elbow");
  blind.sensors.coloured_noise = Eigen::VectorXd();
  blind.sensors.encoder_noise = Eigen::VectorXd();
  blind.sensors.encoder_resolution = Eigen::VectorXd();
  blind.effects = {Usual("torque_ripple", 1)};
  const EffectSize size = Sizes(blind)[0];
  const double torque = TypicalContext(blind.robot, 0).torque[1];
  const double amplitude = blind.effects[0].parameters[0] * torque;
  const double noise = blind.sensors.torque_noise[1] * std::sqrt(12.5 / 125);
  EXPECT_NEAR(size.raw, amplitude / std::sqrt(2) / noise, .2 * size.raw);
  EXPECT_GT(size.enr, .8 * size.raw);
  EXPECT_GT(size.joint_enr[1], .9 * size.enr);
}

// Coarser encoders disturb the residual by way of the controller, so that the
// same effect counts less.
TEST(EffectSize, KnowsTheNoiseOfEncoders) {
  BlindCase blind = RichCase("scara");
  blind.effects = {Usual("stribeck", 1)};
  blind.sensors.encoder_resolution = Eigen::VectorXd::Constant(4, 1e-6);
  const double fine = Sizes(blind)[0].enr;
  blind.sensors.encoder_resolution = Eigen::VectorXd::Constant(4, 5e-5);
  EXPECT_LT(Sizes(blind)[0].enr, .7 * fine);
}

// Friction that is a little more of what the robot has is absorbed within its
// prior: hardly anything of it is left. A log of the robot before tells.
TEST(EffectSize, OfWhatTheModelHasIsAbsorbed) {
  BlindCase blind = RichCase("elbow");
  blind.trust = .06;
  blind.effects = {Usual("viscous_friction", 2)};
  blind.effects[0].parameters[0] = blind.effects[0].kind->parameters[0].low;
  const EffectSize size = Sizes(blind)[0];
  EXPECT_LT(size.enr, .2 * size.raw);
  blind.has_reference = true;
  EXPECT_GT(Sizes(blind)[0].enr, 2 * size.enr);
}

TEST(EffectSize, GrowsWithTheEffect) {
  BlindCase blind = RichCase("scara");
  blind.effects = {Usual("stribeck", 0)};
  blind.effects[0].parameters[0] /= 2;
  const double half = Sizes(blind)[0].enr;
  blind.effects[0].parameters[0] *= 2;
  EXPECT_NEAR(Sizes(blind)[0].enr / half, 2, .1);
}

// Of two effects each has the size that it has alone, where they act apart.
TEST(EffectSize, OfTwoEffects) {
  BlindCase blind = RichCase("elbow");
  blind.effects = {Usual("torque_ripple", 2), Usual("stribeck", 0)};
  const std::vector<EffectSize> both = Sizes(blind);
  blind.effects.resize(1);
  EXPECT_NEAR(both[0].enr, Sizes(blind)[0].enr, .1 * both[0].enr);
  EXPECT_GT(both[1].joint_enr[0], .9 * both[1].enr);
}

// A ripple that no parameter looks like is all that there is to remove, on its
// joint alone: its mean square is A^2 / 2 and, with its overtones, 7 % more.
TEST(OracleGap, OfARippleIsItsMeanSquare) {
  BlindCase blind = RichCase("elbow");
  blind.effects = {Usual("torque_ripple", 1)};
  EffectSizer sizer(blind);
  const auto gap = FindOracleGap(blind, &sizer);
  ASSERT_TRUE(gap);
  const double A =
      blind.effects[0].parameters[0] * TypicalContext(blind.robot, 0).torque[1];
  EXPECT_NEAR(gap->refit[1] - gap->after[1], A * A / 2, .2 * A * A / 2);
  EXPECT_LT(gap->refit[0], .05 * gap->refit[1]);
  EXPECT_LT(gap->refit[2], .05 * gap->refit[1]);
  EXPECT_GT(gap->nominal.sum(), gap->refit.sum());
  EXPECT_GT(gap->RemovedPercent(), 95);
  EXPECT_LE(gap->RemovedPercent(), 100);
}

}  // namespace armcal::effect_size_test
