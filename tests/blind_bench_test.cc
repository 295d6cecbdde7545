#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "model/log_writer.h"
#include "tests/blind/blind_arms.h"
#include "tests/blind/blind_case.h"
#include "tests/blind/effect_size.h"

namespace armcal {
namespace {

BlindCase RichCase(const std::string& arm) {
  for (uint64_t seed = 0;; ++seed) {
    BlindCase blind = DrawBlindCase(seed);
    if (blind.arm != arm || blind.excitation != Excitation::kRich) continue;
    if (blind.points) continue;
    blind.has_reference = false;
    return blind;
  }
}

ChosenEffect Usual(const std::string& name, int joint) {
  const HiddenEffect* kind = FindHiddenEffect(name);
  return {kind, joint, UsualParameters(*kind)};
}

TEST(BlindBench, SetsShareNoSeed) {
  std::set<uint64_t> seeds;
  for (const BlindSet set : {BlindSet::kCalibration, BlindSet::kEvaluation}) {
    for (const uint32_t seed : {0u, 1u, 0x7fffffffu}) {
      for (const uint32_t index : {0u, 1u, 0xffffffffu}) {
        EXPECT_TRUE(seeds.insert(BlindCaseSeed(set, seed, index)).second);
      }
    }
  }
}

TEST(BlindBench, CasesAreAsVariedAsTheyShouldBe) {
  std::set<std::string> arms, excitations;
  int none = 0, two = 0, unknown = 0;
  std::set<std::string> effects;
  for (uint64_t seed = 0; seed < 1000; ++seed) {
    const BlindCase blind = DrawBlindCase(seed);
    arms.insert(blind.arm);
    excitations.insert(ExcitationName(blind.excitation));
    none += blind.effects.empty();
    two += blind.effects.size() == 2;
    for (const ChosenEffect& effect : blind.effects) {
      effects.insert(effect.kind->name);
      unknown += !effect.kind->in_catalogue;
    }
  }
  EXPECT_EQ(arms.size(), BlindArmNames().size());
  EXPECT_EQ(excitations.size(), 4u);
  EXPECT_EQ(effects.size(), HiddenEffects().size());
  EXPECT_NEAR(none, 200, 50);
  EXPECT_NEAR(two, 200, 50);
  EXPECT_NEAR(unknown, 200, 50);
}

TEST(BlindBench, SameSeedSameBytes) {
  const uint64_t seed = BlindCaseSeed(BlindSet::kCalibration, 9, 4);
  std::string texts[2];
  for (std::string& text : texts) {
    const BlindCase blind = DrawBlindCase(seed);
    text = blind.robot_yaml +
           LogText(RunScenario(BlindScenario(blind, BlindLog::kValidation,
                                             blind.effects))
                       .run.log);
  }
  EXPECT_EQ(texts[0], texts[1]);
}

// A ripple of amplitude A that no parameter of the model looks like has an rms
// torque of A / sqrt(2).
TEST(EffectSize, OfARippleIsItsRmsOverTheNoise) {
  BlindCase blind = RichCase("elbow");
  blind.sensors.coloured_noise = Eigen::VectorXd();
  blind.effects = {Usual("torque_ripple", 1)};
  const EffectSize size = EffectSizes(blind)[0];
  const double torque = TypicalContext(blind.robot, 0).torque[1];
  const double amplitude = blind.effects[0].parameters[0] * torque;
  // White noise at 250 Hz that passes a zero-phase filter of 10 Hz keeps nearly
  // a twelfth of its power (that of order 4, squared: 0.97 of 10 in 125 Hz).
  const double noise = blind.sensors.torque_noise[1] * std::sqrt(.9 * 10 / 125);
  EXPECT_NEAR(size.raw, amplitude / std::sqrt(2) / noise, .15 * size.raw);
  EXPECT_GT(size.enr, .8 * size.raw);
  EXPECT_GT(size.joint_enr[1], .9 * size.enr);
}

// Friction that is a little more of what the robot has is absorbed within its
// prior: hardly anything of it is left.
TEST(EffectSize, OfWhatTheModelHasIsAbsorbed) {
  BlindCase blind = RichCase("elbow");
  blind.trust = .06;
  blind.effects = {Usual("viscous_friction", 2)};
  blind.effects[0].parameters[0] = blind.effects[0].kind->parameters[0].low;
  const EffectSize size = EffectSizes(blind)[0];
  EXPECT_LT(size.enr, .2 * size.raw);
}

TEST(EffectSize, GrowsWithTheEffect) {
  BlindCase blind = RichCase("scara");
  blind.effects = {Usual("stribeck", 0)};
  blind.effects[0].parameters[0] /= 2;
  const double half = EffectSizes(blind)[0].enr;
  blind.effects[0].parameters[0] *= 2;
  EXPECT_NEAR(EffectSizes(blind)[0].enr / half, 2, .1);
}

}  // namespace
}  // namespace armcal
