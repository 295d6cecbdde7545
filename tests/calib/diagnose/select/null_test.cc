#include "calib/diagnose/select/null.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::null_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kCandidates = 20;
constexpr int kLogs = 60;

// Rows of a log of 60 s, and waves of many periods as candidates of joint 1.
class GapNullTest : public testing::Test {
 protected:
  GapNullTest() : effects_(kCandidates) {
    const EffectArm arm("2R planar (vertical plane)", 60, .02);
    GapSegment segment;
    segment.motion = arm.motion;
    segment.tau = MatrixXd::Zero(segment.size(), 2);
    segment.still.setConstant(segment.size(), 2, false);
    segments_ = {segment};
    rows_.emplace(segments_, 6);
    rows_->SetNoise(std::vector<Autoregression>(2),
                    MatrixXd::Zero(rows_->num_thin(), 2));
    for (int k = 0; k < kCandidates; ++k) {
      GapCandidate candidate;
      effects_[k].parameters.resize(1);
      candidate.effect = &effects_[k];
      candidate.joint = 0;
      candidate.linear = {0};
      candidate.columns = {k};
      candidates_.push_back(candidate);
    }
  }
  VectorXd Wave(int candidate) const {
    return VectorXd::NullaryExpr(rows_->num_rows(0), [=](Eigen::Index i) {
      return std::sin(2 * M_PI * (candidate + 3) * i / rows_->num_rows(0));
    });
  }
  // Noise that keeps its sign for `memory` samples or so.
  VectorXd Noise(double memory) {
    VectorXd x(rows_->num_rows(0));
    const double keep = std::exp(-1 / memory);
    double last = Normal(&random_);
    for (double& value : x) {
      last = keep * last + std::sqrt(1 - keep * keep) * Normal(&random_);
      value = last;
    }
    return x;
  }
  GapScreen Screen(const VectorXd& target) const {
    GapScreen screen(
        OnEachJoint({MatrixXd::Constant(rows_->num_rows(0), 1, 1e-3),
                     MatrixXd::Constant(rows_->num_rows(1), 1, 1e-3)}),
        1, {target, VectorXd::Zero(rows_->num_rows(1))});
    for (int k = 0; k < kCandidates; ++k) {
      JointRows column(2);
      column[0] = Wave(k);
      screen.AddColumn(column);
    }
    screen.Factor();
    return screen;
  }
  double ByChance(const GapScreen& screen,
                  const std::vector<int>& chosen = {}) {
    return ScoreByChance(screen, *rows_, candidates_, {}, chosen, 0, 1);
  }
  double Best(const GapScreen& screen) {
    return ScoresGiven(screen, candidates_, {}, {}, -1).maxCoeff();
  }

  std::mt19937_64 random_{3};
  std::vector<Effect> effects_;
  std::vector<GapSegment> segments_;
  std::optional<GapRows> rows_;
  std::vector<GapCandidate> candidates_;
};

// Noise with a memory that the whitening did not know of scores high: as high
// as chance says it may.
TEST_F(GapNullTest, NoiseWithAMemoryRarelyExceedsWhatChanceGives) {
  int above_threshold = 0, above_chance = 0;
  for (int k = 0; k < kLogs; ++k) {
    const GapScreen screen = Screen(Noise(8));
    const double best = Best(screen);
    above_threshold += best > SelectionOptions().threshold;
    above_chance += best > ByChance(screen);
  }
  EXPECT_GT(above_threshold, kLogs / 4);
  EXPECT_LE(above_chance, 4);  // 0.6 expected
}

TEST_F(GapNullTest, WhiteNoiseScoresLittle) {
  EXPECT_LT(ByChance(Screen(Noise(.01))), SelectionOptions().threshold);
}

// An effect that runs through the whole log is far above its own chance, and
// no chance beside it once it is chosen.
TEST_F(GapNullTest, AnEffectIsNoChance) {
  const GapScreen screen = Screen(Wave(5) + Noise(.01));
  EXPECT_GT(Best(screen), 2 * ByChance(screen));
  EXPECT_LT(ByChance(screen, {5}), SelectionOptions().threshold);
}

// What a wrong form leaves on one joint is no reason to doubt another's effect.
TEST_F(GapNullTest, ErrorsOfOneJointAreNotThoseOfAnother) {
  GapScreen screen(
      OnEachJoint({MatrixXd::Constant(rows_->num_rows(0), 1, 1e-3),
                   MatrixXd::Constant(rows_->num_rows(1), 1, 1e-3)}),
      1, {Noise(.01), 30 * Noise(8)});
  for (int joint = 0; joint < 2; ++joint) {
    for (int k = 0; k < kCandidates; ++k) {
      JointRows column(2);
      column[joint] = Wave(k);
      screen.AddColumn(column);
      if (joint == 0) continue;
      candidates_.push_back(candidates_[k]);
      candidates_.back().joint = 1;
      candidates_.back().columns = {kCandidates + k};
    }
  }
  screen.Factor();
  EXPECT_LT(ScoreByChance(screen, *rows_, candidates_, {}, {}, 0, 1), 25);
  EXPECT_GT(ScoreByChance(screen, *rows_, candidates_, {}, {}, 1, 1), 1000);
}

}  // namespace armcal::null_test
