// Monte Carlo runs of EstimateDriveGains: bias, and whether intervals hold the
// truth as often as they claim.

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/fixtures/drive_gain_runs.h"

namespace armcal::drive_gains_long_test {

using Eigen::VectorXd;

class Intervals : public testing::TestWithParam<const char*> {};

// Errors over runs, in units of what is claimed.
struct Errors {
  explicit Errors(int n) : sum(VectorXd::Zero(n)), squares(sum), covered(sum) {}
  void Add(const DriveGains& result, const VectorXd& K) {
    for (int j = 0; j < K.size(); ++j) {
      const DriveGain& gain = result.gains[j];
      const double z = (gain.value - K[j]) / gain.stddev;
      sum[j] += z;
      squares[j] += z * z;
      covered[j] += std::abs(z) < 1.96;
      relative += gain.stddev / K[j] / static_cast<double>(K.size());
    }
    ++runs;
  }
  VectorXd sum, squares, covered;
  double relative = 0;
  int runs = 0;
};

// A new arm with new drives and new motion in every run; 2 % of the current's
// rms as noise in every sample, encoders of 1e-4 rad (m).
TEST_P(Intervals, AreTrue) {
  constexpr int kRuns = 400;
  std::mt19937_64 random(5);
  const int n = SampleRobot(GetParam()).num_joints();
  Errors errors(n);
  for (int run = 0; run < kRuns; ++run) {
    const DrivenArm driven = MakeDrivenArm(GetParam(), &random);
    Log bare = ToCurrents(MoveArm(driven.arm.truth, 20, &random), driven.K);
    Log loaded = ToCurrents(MoveArm(Loaded(driven), 20, &random), driven.K);
    AddDriveNoise(.02, 1e-4, &random, &bare);
    AddDriveNoise(.02, 1e-4, &random, &loaded);
    const DriveGains result = EstimateFromLogs(
        driven.arm.file, driven.payload.mass, {bare}, {loaded}, DriveOptions());
    ASSERT_TRUE(result.solved) << result.reason;
    errors.Add(result, driven.K);
  }
  std::printf("%s: %.3f %%; mean z, rms z, coverage %%\n", GetParam(),
              100 * errors.relative / kRuns);
  for (int j = 0; j < n; ++j) {
    std::printf("  joint%d %6.2f %6.2f %6.1f\n", j + 1, errors.sum[j] / kRuns,
                std::sqrt(errors.squares[j] / kRuns),
                100 * errors.covered[j] / kRuns);
    EXPECT_LT(std::abs(errors.sum[j] / kRuns), .5) << j;
  }
  const double coverage = 100 * errors.covered.mean() / kRuns;
  std::printf("  all    %20.1f\n", coverage);
  EXPECT_GE(coverage, 93);
  EXPECT_LE(coverage, 97);
}

INSTANTIATE_TEST_SUITE_P(, Intervals,
                         testing::Values("SCARA RRPR", "UR5 6R", "Panda 7R"));

}  // namespace armcal::drive_gains_long_test
