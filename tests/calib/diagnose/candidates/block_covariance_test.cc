#include "calib/diagnose/candidates/block_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::block_covariance_test {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr int kRows = 2000, kBlock = 20;

// Two parameters that swing slowly.
RowMajorMatrix Slopes() {
  RowMajorMatrix J(kRows, 2);
  for (int i = 0; i < kRows; ++i) J.row(i) << std::sin(.01 * i), 1;
  return J;
}

std::vector<int> Blocks() {
  std::vector<int> blocks(kRows);
  for (int i = 0; i < kRows; ++i) blocks[i] = i / kBlock;
  return blocks;
}

// Deviations of estimates about the truth, and the deviations that are told of
// them: of noise of variance 1 that is alike over `alike` samples.
struct Deviations {
  Vector2d made = Vector2d::Zero(), told = Vector2d::Zero();
};
Deviations OfNoise(double alike, std::mt19937_64* random) {
  constexpr int kDraws = 400;
  const RowMajorMatrix J = Slopes();
  const MatrixXd inverse = (J.transpose() * J).inverse();
  const double keeps = std::exp(-1 / alike);
  Deviations deviations;
  for (int draw = 0; draw < kDraws; ++draw) {
    VectorXd noise(kRows);
    double now = Normal(random);
    for (int i = 0; i < kRows; ++i) {
      noise[i] = now;
      now = keeps * now + std::sqrt(1 - keeps * keeps) * Normal(random);
    }
    const Vector2d x = inverse * (J.transpose() * noise);
    deviations.made += x.cwiseAbs2() / kDraws;
    deviations.told +=
        BlockCovariance(J, noise - J * x, Blocks()).diagonal() / kDraws;
  }
  deviations.made = deviations.made.cwiseSqrt();
  deviations.told = deviations.told.cwiseSqrt();
  return deviations;
}

// White noise's covariance would be a third of these: 2 x 5 samples tell as
// much as one.
TEST(BlockCovariance, IsThatOfNoiseThatLasts) {
  std::mt19937_64 random(3);
  const Deviations deviations = OfNoise(5, &random);
  const RowMajorMatrix J = Slopes();
  const MatrixXd white = (J.transpose() * J).inverse();
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(deviations.told[k] / deviations.made[k], 1, .15);
    EXPECT_GT(deviations.made[k], 2.5 * std::sqrt(white(k, k)));
  }
}

// Of white noise blocks differ by chance: what is told is larger by that.
TEST(BlockCovariance, OfWhiteNoiseIsHardlyMore) {
  std::mt19937_64 random(4);
  const Deviations deviations = OfNoise(.01, &random);
  for (int k = 0; k < 2; ++k) {
    EXPECT_GT(deviations.told[k] / deviations.made[k], .95);
    EXPECT_LT(deviations.told[k] / deviations.made[k], 1.15);
  }
}

// A residual of nothing would leave nothing by blocks.
TEST(BlockCovariance, IsNoLessThanNoiseGives) {
  const RowMajorMatrix J = Slopes();
  const MatrixXd white = (J.transpose() * J).inverse();
  EXPECT_LT(
      (BlockCovariance(J, VectorXd::Zero(kRows), Blocks()) - white).norm(),
      1e-9 * white.norm());
}

// Two blocks say nothing of two parameters.
TEST(BlockCovariance, OfFewBlocksIsThatOfNoise) {
  const RowMajorMatrix J = Slopes();
  std::vector<int> blocks(kRows);
  for (int i = 0; i < kRows; ++i) blocks[i] = i / (kRows / 2);
  const MatrixXd white = (J.transpose() * J).inverse();
  EXPECT_LT((BlockCovariance(J, VectorXd::Ones(kRows), blocks) - white).norm(),
            1e-9 * white.norm());
}

TEST(BlockCovariance, OfWhatNothingDependsOnIsNone) {
  RowMajorMatrix J = Slopes();
  J.col(0).setZero();
  const MatrixXd covariance =
      BlockCovariance(J, VectorXd::Zero(kRows), Blocks());
  EXPECT_EQ(covariance(0, 0), 0);
  EXPECT_NEAR(covariance(1, 1), 1. / kRows, 1e-12);
}

// 20 s in blocks of 4 / (8 Hz), of two joints whose blocks are the same.
TEST(BlocksOfRows, AreTimesOfAllJoints) {
  const EffectArm arm("2R planar (vertical plane)", 20, .01);
  const std::vector<GapSegment> segments = {
      MakeSegment(arm.motion, arm.Recorded().nominal())};
  const GapRows rows(segments, 8);
  const std::vector<int> blocks = BlocksOfRows(rows);
  ASSERT_EQ(static_cast<int>(blocks.size()), rows.num_rows());
  const auto first = rows.PlacesOfRows(0);
  std::set<int> of_first(blocks.begin(), blocks.begin() + first.size());
  std::set<int> all(blocks.begin(), blocks.end());
  EXPECT_EQ(of_first, all);
  EXPECT_NEAR(all.size(), 40, 4);  // less the bent ends
  for (size_t k = 1; k < first.size(); ++k) {
    const bool same =
        std::floor(first[k].time / .5) == std::floor(first[k - 1].time / .5);
    EXPECT_EQ(blocks[k] == blocks[k - 1], same);
  }
}

}  // namespace armcal::block_covariance_test
