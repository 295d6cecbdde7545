#include "calib/linear/score_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "model/signals/dense_solvers.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::score_covariance_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Series = std::vector<VectorXd>;

Series RandomSeries(std::mt19937_64* random, int count, int size) {
  Series series;
  for (int k = 0; k < count; ++k) {
    series.push_back(UniformVector(random, size, -1, 2));
  }
  return series;
}

// Newey and West (1987), literally, over series that do not follow each other.
MatrixXd DoubleSum(const std::vector<Series>& all, int window, int size) {
  MatrixXd sum = MatrixXd::Zero(size, size);
  for (const Series& s : all) {
    const int count = static_cast<int>(s.size());
    for (int a = 0; a < count; ++a) {
      for (int b = 0; b < count; ++b) {
        const double weight = 1 - std::abs(a - b) / double(window);
        if (weight > 0) sum += weight * s[a] * s[b].transpose();
      }
    }
  }
  return sum;
}

MatrixXd InOnePass(const std::vector<Series>& all, int window, int size) {
  ScoreCovariance scores(size, window);
  for (const Series& s : all) {
    scores.Break();
    for (const VectorXd& score : s) scores.Add({score, {}, {}});
  }
  return scores.Value();
}

TEST(ScoreCovariance, IsTheLiteralDoubleSum) {
  std::mt19937_64 random(1);
  for (const int window : {1, 2, 3, 7, 20, 50}) {
    for (const std::vector<int>& lengths : {std::vector<int>{200},
                                            {50},
                                            {49},
                                            {51},
                                            {3},
                                            {1},
                                            {2, 100, 7},
                                            {1, 1, 1, 40},
                                            {0, 6, 0}}) {
      std::vector<Series> all;
      for (const int length : lengths) {
        all.push_back(RandomSeries(&random, length, 3));
      }
      const MatrixXd expected = DoubleSum(all, window, 3);
      const MatrixXd value = InOnePass(all, window, 3);
      EXPECT_LT((value - expected).norm(), 1e-11 * (1 + expected.norm()))
          << "window " << window << ", first length " << lengths[0];
      EXPECT_EQ(value, value.transpose());
    }
  }
}

TEST(ScoreCovariance, NothingAddedIsZero) {
  EXPECT_EQ(ScoreCovariance(2, 5).Value(), MatrixXd::Zero(2, 2));
}

// Where the plain truncated sum would not be.
TEST(ScoreCovariance, IsPositiveSemidefinite) {
  Series series;
  for (int k = 0; k < 60; ++k) {
    series.push_back(Eigen::Vector2d(k % 2 ? 1 : -1, k % 3 - 1));
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(
      InOnePass({series}, 6, 2));
  EXPECT_GT(eigen.eigenvalues()[0], -1e-12);
}

// A term of an AR(1) series adds 1 / (1 - rho)^2 to the variance of the sum in
// the long run; Bartlett's window, as wide as Andrews says, comes near to it
// from below.
TEST(ScoreCovariance, LongRunVarianceOfAutoregression) {
  std::mt19937_64 random(7);
  constexpr long kCount = 20000, kRuns = 60;
  for (const double rho : {0., .5, .8}) {
    const int window = BartlettWindow(rho, kCount, 1);
    double mean = 0;
    for (int run = 0; run < kRuns; ++run) {
      ScoreCovariance scores(1, window);
      double x = Normal(&random) / std::sqrt(1 - rho * rho);
      for (long k = 0; k < kCount; ++k) {
        scores.Add({VectorXd::Constant(1, x), {}, {}});
        x = rho * x + Normal(&random);
      }
      mean += scores.Value()(0, 0) / kCount / kRuns;
    }
    const double truth = 1 / std::pow(1 - rho, 2);
    double bartlett = 1;
    for (int l = 1; l < window; ++l) {
      bartlett += 2 * (1 - l / double(window)) * std::pow(rho, l);
    }
    bartlett /= 1 - rho * rho;
    EXPECT_NEAR(mean / bartlett, 1, .03) << rho;
    EXPECT_NEAR(mean / truth, 1, .08) << rho;
  }
}

// Y = U x + e with independent e: E[score score'] of a window is M - M G M, M
// its U'U and G the fit's gain; the sums made up for the fit have M again, so
// that the sandwich is G, the covariance of x. 30 rows for 6 parameters, some
// of which few rows tell of.
TEST(ScoreCovariance, GivesBackWhatTheFitHasTaken) {
  constexpr int kRows = 30, kSize = 6, kRuns = 4000;
  std::mt19937_64 random(3);
  MatrixXd U(kRows, kSize);
  for (double& u : U.reshaped()) u = Normal(&random);
  U.col(5).tail(24).setZero();
  const MatrixXd gain = (U.transpose() * U).inverse();
  for (const int window : {1, 3}) {
    VectorXd plain = VectorXd::Zero(kSize), made_up = plain;
    for (int run = 0; run < kRuns; ++run) {
      VectorXd e(kRows);
      for (double& x : e) x = Normal(&random);
      const VectorXd r = e - U * (gain * (U.transpose() * e));
      ScoreCovariance as_it_is(kSize, window), corrected(kSize, window, gain);
      for (int k = 0; k < kRows; ++k) {
        const Score score{U.row(k).transpose() * r[k], U.row(k), U.row(k)};
        as_it_is.Add(score);
        corrected.Add(score);
      }
      plain += (gain * as_it_is.Value() * gain).diagonal() / kRuns;
      made_up += (gain * corrected.Value() * gain).diagonal() / kRuns;
    }
    const VectorXd ratio = made_up.cwiseQuotient(gain.diagonal());
    const VectorXd before = plain.cwiseQuotient(gain.diagonal());
    EXPECT_LT(before.maxCoeff(), .9) << window;
    EXPECT_NEAR(ratio.mean(), 1, .05) << window;
    EXPECT_GT(ratio.minCoeff(), .85) << window;
    EXPECT_LT(ratio.maxCoeff(), 1.1) << window;
  }
}

// Andrews (1991), (5.3), (6.2), (6.4): 1.1447 (alpha(1) T)^(1/3) lags with
// alpha(1) = 4 rho^2 / ((1 - rho)^2 (1 + rho)^2).
TEST(BartlettWindow, IsAndrews) {
  // rho = .5: alpha = 1.7778; T = 1000: 13.87 lags.
  EXPECT_EQ(BartlettWindow(.5, 1000, 1), 15);
  // rho = .9: alpha = 89.75; T = 10000: 110.4 lags.
  EXPECT_EQ(BartlettWindow(.9, 10000, 1), 112);
}

TEST(BartlettWindow, StaysWithinItsBounds) {
  EXPECT_EQ(BartlettWindow(0, 1000, 6), 6);
  EXPECT_EQ(BartlettWindow(-.9, 1000, 6), 6);
  EXPECT_EQ(BartlettWindow(.95, 100, 6), 20);
  EXPECT_EQ(BartlettWindow(.5, 20, 6), 4);
  EXPECT_EQ(BartlettWindow(.5, 2, 6), 1);
  EXPECT_EQ(BartlettWindow(1, 1 << 30, 6), BartlettWindow(.97, 1 << 30, 6));
}

}  // namespace armcal::score_covariance_test
