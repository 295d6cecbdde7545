#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "model/log_files/log_writer.h"
#include "model/plant/random_stream.h"
#include "tests/blind/blind_arms.h"
#include "tests/blind/blind_case.h"
#include "tests/blind/residual_noise.h"

namespace armcal::bench_test {

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

// No two streams of random numbers begin alike, whatever they are for.
TEST(RandomStream, DiffersByRobotRunAndPurpose) {
  std::set<uint64_t> first;
  int count = 0;
  for (const uint64_t seed : {0ull, 1ull, 1ull << 32, 1ull << 63}) {
    for (const uint64_t run : {0, 1, 2}) {
      for (int purpose = 0; purpose <= static_cast<int>(RandomPurpose::kDrift);
           ++purpose, ++count) {
        first.insert(
            RandomStream(seed, run, static_cast<RandomPurpose>(purpose))());
      }
    }
  }
  EXPECT_EQ(static_cast<int>(first.size()), count);
}

}  // namespace armcal::bench_test
