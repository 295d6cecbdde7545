#include "calib/watch/null_model.h"

#include <gmock/gmock.h>

#include "calib/watch/two_pole.h"
#include "tests/calib/watch/watched_arm.h"

namespace armcal::null_model_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// White noise through the filter, an hour of it: how often it leaves 3 standard
// deviations, to either side, is what Rice's formula says.
TEST(NullModel, RiceLevelIsCrossedAsOften) {
  constexpr double kBandwidth = 20, kStep = .0005;
  constexpr long kSamples = 2'000'000;
  std::mt19937_64 random(1);
  TwoPole filter(2 * M_PI * kBandwidth);
  filter.Start(MatrixXd::Zero(1, 1));
  std::vector<double> x;
  double squares = 0;
  for (long k = 0; k < kSamples; ++k) {
    filter.Step(kStep, MatrixXd::Constant(1, 1, Normal(&random)));
    x.push_back(filter.value()(0, 0));
    squares += x.back() * x.back();
  }
  const double level =
      RiceLevel(kBandwidth, .4) * std::sqrt(squares / kSamples);
  long crossings = 0;
  for (long k = 1; k < kSamples; ++k) {
    crossings += std::abs(x[k]) > level && std::abs(x[k - 1]) <= level;
  }
  // 400 expected in 1000 s; upcrossings come in clumps, if rarely.
  EXPECT_NEAR(crossings / (kSamples * kStep), .4, .08);
}

// Rows whose residual is white noise of a known size.
std::vector<WatchRow> NoiseRows(const WatchModel& model, double sigma,
                                double tail, int seed) {
  std::mt19937_64 random(seed);
  std::vector<WatchRow> rows(3000);
  for (size_t k = 0; k < rows.size(); ++k) {
    WatchRow& row = rows[k];
    row.t = .01 * k;
    row.A = MatrixXd::Zero(3, model.size() + 6);
    for (double& value : row.A.reshaped()) value = Normal(&random);
    row.r.resize(3);
    for (double& value : row.r) {
      value = sigma * Normal(&random);
      if (k % 100 == 0) value *= tail;
    }
    row.crossing = row.standing = VectorXd::Zero(3);
  }
  return rows;
}

NullModel Learned(double sigma, double tail) {
  const WatchModel model = WatchedModel(WatchedRobot());
  ParameterBelief belief{VectorXd::Zero(model.size()), model.covariance};
  return LearnNull(NoiseRows(model, sigma, tail, 2), model,
                   MakeWatchHypotheses(model), {}, &belief);
}

TEST(NullModel, LearnsTheNoise) {
  const NullModel null = Learned(.3, 1);
  for (int j = 0; j < 3; ++j) {
    EXPECT_NEAR(std::sqrt(null.sigma2[j]), .3, .02);
    EXPECT_LT(null.long_run[j], 2);
    // A false alarm in ten hours, half of them this joint's third.
    EXPECT_GT(null.threshold[j], RiceLevel(20, .1 / 3600 / 12) - .05);
    EXPECT_LT(null.threshold[j], 9);
  }
}

TEST(NullModel, HeavyTailsMoveTheLimit) {
  EXPECT_GT(Learned(.3, 6).threshold.minCoeff(),
            1.3 * Learned(.3, 1).threshold.maxCoeff());
}

// A joint that stands is the same unknown torque in every row.
TEST(NullModel, StandingRowsWeighLittle) {
  const NullModel null = Learned(.3, 1);
  WatchRow row;
  row.crossing = row.standing = VectorXd::Zero(3);
  const VectorXd moving = null.Weight(row);
  row.standing.setOnes();
  EXPECT_GT((moving.cwiseQuotient(null.Weight(row))).minCoeff(), 1000);
}

}  // namespace armcal::null_model_test
