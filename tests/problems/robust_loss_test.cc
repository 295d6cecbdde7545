#include "problems/robust_loss.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "tests/fixtures/sample_motion.h"

namespace armcal::robust_loss_test {

constexpr RobustLoss kRobust[] = {RobustLoss::kHuber, RobustLoss::kCauchy,
                                  RobustLoss::kTukey};

double Weight(RobustLoss loss, double r) {
  return EvaluateLoss(loss, r).weight;
}
double Score(RobustLoss loss, double r) { return r * Weight(loss, r); }

// Efficiency of the location of normal errors of `size` coordinates that share
// a loss, (mean slope)^2 / mean square of a score's coordinate, by the midpoint
// rule over the error's length (chi distribution).
double Efficiency(RobustLoss loss, int size) {
  const std::unique_ptr<ceres::LossFunction> rho(MakeLoss(loss, size));
  constexpr double kStep = 1e-4;
  double density = 0, slope = 0, square = 0;
  for (int k = 0; k < 120000; ++k) {
    const double r = (k + .5) * kStep, s = r * r;
    const double p = std::pow(r, size - 1) * std::exp(-s / 2);
    double value[3];
    rho->Evaluate(s, value);
    density += p;
    slope += p * (value[1] + 2 * value[2] * s / size);
    square += p * value[1] * value[1] * s / size;
  }
  return slope * slope / (square * density);
}

TEST(RobustLoss, IsNinetyFivePercentEfficient) {
  for (const RobustLoss loss : kRobust) {
    for (const int size : {1, 2, 3, 6}) {
      EXPECT_NEAR(Efficiency(loss, size), .95, 5e-4)
          << static_cast<int>(loss) << " " << size;
    }
  }
}

// Holland and Welsch (1977), table of tuning constants.
TEST(RobustLoss, ScalesOfSingleResiduals) {
  EXPECT_EQ(LossScale(RobustLoss::kHuber), 1.345);
  EXPECT_EQ(LossScale(RobustLoss::kCauchy), 2.385);
  EXPECT_EQ(LossScale(RobustLoss::kTukey), 4.685);
}

TEST(RobustLoss, WeightsByTheirFormulas) {
  for (const double r : {-9., -4., -1.4, -.1, 0., .5, 1.3, 2., 4.6, 100.}) {
    const double size = std::abs(r);
    EXPECT_EQ(Weight(RobustLoss::kSquared, r), 1);
    EXPECT_NEAR(Weight(RobustLoss::kHuber, r), size < 1.345 ? 1 : 1.345 / size,
                1e-12);
    EXPECT_NEAR(Weight(RobustLoss::kCauchy, r),
                1 / (1 + std::pow(r / 2.385, 2)), 1e-12);
    EXPECT_NEAR(Weight(RobustLoss::kTukey, r),
                size < 4.685 ? std::pow(1 - std::pow(r / 4.685, 2), 2) : 0,
                1e-12);
  }
}

TEST(RobustLoss, SlopeIsThatOfTheScore) {
  for (const RobustLoss loss : {RobustLoss::kSquared, RobustLoss::kHuber,
                                RobustLoss::kCauchy, RobustLoss::kTukey}) {
    for (const double r : {-9., -1.4, -1.3, -.1, 0., .1, 1.3, 1.4, 4., 9.}) {
      const double slope =
          (Score(loss, r + 1e-6) - Score(loss, r - 1e-6)) / 2e-6;
      EXPECT_NEAR(slope, EvaluateLoss(loss, r).slope, 1e-6)
          << static_cast<int>(loss) << " " << r;
    }
  }
}

// A location estimated by iterated weights, against the mean.
TEST(RobustLoss, CostsLittleOnNormalErrorsAndResistsOutliers) {
  constexpr int kCount = 100, kRuns = 4000;
  for (const RobustLoss loss : kRobust) {
    std::mt19937_64 random(1);
    double mean_squares = 0, squares = 0, outlier_squares = 0;
    const auto location = [loss](const std::vector<double>& r) {
      double at = 0;
      for (int pass = 0; pass < 20; ++pass) {
        double sum = 0, weights = 0;
        for (const double x : r) {
          sum += x * Weight(loss, x - at);
          weights += Weight(loss, x - at);
        }
        at = sum / weights;
      }
      return at;
    };
    for (int run = 0; run < kRuns; ++run) {
      std::vector<double> r(kCount);
      double mean = 0;
      for (double& x : r) mean += (x = Normal(&random)) / kCount;
      mean_squares += mean * mean;
      squares += std::pow(location(r), 2);
      r[0] = r[1] = 1000;
      outlier_squares += std::pow(location(r), 2);
    }
    EXPECT_NEAR(std::sqrt(squares / mean_squares), 1 / std::sqrt(.95), .01);
    EXPECT_LT(std::sqrt(outlier_squares / mean_squares), 1.15);
  }
}

}  // namespace armcal::robust_loss_test
