#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "model/log_writer.h"
#include "model/plant/random_stream.h"
#include "tests/blind/blind_arms.h"
#include "tests/blind/blind_case.h"
#include "tests/blind/effect_size.h"
#include "tests/blind/residual_noise.h"

namespace armcal {
namespace {

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
  std::set<std::string> arms, joints;
  int references = 0, points = 0;
  constexpr int kCases = 400;
  for (uint64_t seed = 0; seed < kCases; ++seed) {
    const BlindCase blind =
        DrawBlindCase(seed, PlanCase(Stratum::kOne, seed % 8));
    arms.insert(blind.arm);
    references += blind.has_reference;
    points += blind.points;
    EXPECT_EQ(blind.effects[0].kind, blind.plan.effect);
    joints.insert(blind.arm + std::to_string(blind.effects[0].joint));
  }
  EXPECT_EQ(arms.size(), BlindArmNames().size());
  EXPECT_EQ(joints.size(), 4u + 3 + 6 + 6 + 7);  // each of each arm
  EXPECT_NEAR(references, .4 * kCases, 40);
  EXPECT_NEAR(points, .25 * kCases, 40);
}

TEST(BlindBench, SameSeedSameBytes) {
  const uint64_t seed = BlindCaseSeed(BlindSet::kCalibration, 9, 4);
  std::string texts[2];
  for (std::string& text : texts) {
    const BlindCase blind = DrawBlindCase(seed, PlanCase(Stratum::kTwo, 3));
    text = blind.robot_yaml +
           LogText(RunScenario(BlindScenario(blind, BlindLog::kValidation,
                                             blind.effects))
                       .run.log);
  }
  EXPECT_EQ(texts[0], texts[1]);
}

// The bench's noise model on noise whose model is known.
TEST(ResidualNoise, FindsAnAutoregressionAndWhitensIt) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const Eigen::Vector3d a(.6, -.3, .1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(50000);
  for (int t = 3; t < x.size(); ++t) {
    x[t] = a[0] * x[t - 1] + a[1] * x[t - 2] + a[2] * x[t - 3] +
           .7 * normal(random);
  }
  const ResidualNoise noise = ResidualNoise::Fit(x);
  EXPECT_LT((noise.a - a).norm(), .02);
  EXPECT_NEAR(noise.sigma, .7, .01);
  const Eigen::VectorXd white = noise.Whiten(x);
  ASSERT_EQ(white.size(), x.size() - 3);
  EXPECT_NEAR(white.squaredNorm() / white.size(), 1, .03);
  EXPECT_NEAR(white.tail(40000).dot(white.segment(white.size() - 40001, 40000)),
              0, .02 * 40000);
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

// No two streams of random numbers begin alike, whatever they are for.
TEST(RandomStream, DiffersByRobotRunAndPurpose) {
  std::set<uint64_t> first;
  int count = 0;
  for (const uint64_t seed : {0ull, 1ull, 1ull << 32, 1ull << 63}) {
    for (const uint64_t run : {0, 1, 2}) {
      for (int purpose = 0; purpose <= static_cast<int>(RandomPurpose::kLoss);
           ++purpose, ++count) {
        first.insert(
            RandomStream(seed, run, static_cast<RandomPurpose>(purpose))());
      }
    }
  }
  EXPECT_EQ(static_cast<int>(first.size()), count);
}

}  // namespace
}  // namespace armcal
