// How often the intervals of rollouts hold the truth, windows being independent
// or alike for a while.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "calib/verify/rollout_figures.h"

namespace armcal::rollout_long_test {

constexpr int kTrials = 400;

struct Study {
  int judged = 0;
  int holds = 0;  // of those
};

// Errors of two models, the second's twice the first's but for its own noise,
// both in runs: a log-normal spread of a factor of 2 in between.
Rollouts Draw(int windows, int run, std::mt19937_64* random) {
  std::normal_distribution<double> normal;
  const int phase = static_cast<int>((*random)() % run);
  Rollouts rollouts{.5, {}};
  double a = 0, b = 0;
  for (int k = 0; k < windows; ++k) {
    if (k == 0 || (k + phase) % run == 0) {
      const double common = normal(*random);
      a = std::exp(.7 * common + .5 * normal(*random));
      b = 2 * std::exp(.7 * common + .5 * normal(*random));
    }
    Eigen::MatrixXd q(2, 1);
    q << a, b;
    rollouts.windows.push_back({0, .5 * k, q, q, q, {}});
  }
  return rollouts;
}

void Count(const RolloutFigure& figure, double truth, Study* study) {
  if (!figure.can_judge()) return;
  ++study->judged;
  study->holds += figure.low <= truth && truth <= figure.high;
}

// A verdict is wrong at most in one of ten cases; where verdicts are common
// (in a quarter of the cases) so many of them are right.
void Expect(const char* what, int windows, int run, const Study& study) {
  std::printf(
      "%-6s %3d windows in runs of %d: judged %.2f, of these %.3f hold\n", what,
      windows, run, study.judged / double(kTrials),
      study.holds / std::max(1.0, double(study.judged)));
  EXPECT_LE(study.judged - study.holds, .1 * kTrials);
  if (4 * study.judged >= kTrials) {
    EXPECT_GE(study.holds, .9 * study.judged);
  }
}

class RolloutIntervals : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Windows, RolloutIntervals,
                         testing::Values(30, 60, 200));
TEST_P(RolloutIntervals, HoldTheTruthWhereTheyJudge) {
  const int windows = GetParam();
  for (const int run : {1, 3, 6}) {
    std::mt19937_64 random(1000 * windows + run);
    Study median, ratio;
    for (int trial = 0; trial < kTrials; ++trial) {
      const Rollouts rollouts = Draw(windows, run, &random);
      Count(MedianError(rollouts, 0, {0}, trial), 1, &median);
      Count(MedianRatio(rollouts, 1, 0, {0}, trial), 2, &ratio);
    }
    Expect("median", windows, run, median);
    Expect("ratio", windows, run, ratio);
    // It does judge where there are windows enough.
    if (windows >= 33 * run) {
      EXPECT_GT(median.judged, .9 * kTrials);
    }
  }
}

}  // namespace armcal::rollout_long_test
