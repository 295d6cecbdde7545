#include "model/signals/spikes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace armcal::spikes_test {

using Eigen::MatrixXd;

MatrixXd Noisy(int n, double sigma, std::mt19937_64* random) {
  std::normal_distribution<double> normal(0, sigma);
  MatrixXd x(n, 1);
  for (int k = 0; k < n; ++k) {
    x(k, 0) = 10 * std::sin(0.02 * k) + (std::sin(0.01 * k) > 0 ? 3 : -3) +
              normal(*random);
  }
  return x;
}

// 5 % of the samples 20 standard deviations too high, wherever they fall.
TEST(RemoveSpikes, FindsWhatSticksOut) {
  std::mt19937_64 random(1);
  const MatrixXd clean = Noisy(4000, 0.1, &random);
  MatrixXd x = clean;
  int planted = 0;
  Eigen::Array<bool, Eigen::Dynamic, 1> is_spike(4000);
  for (int k = 0; k < 4000; ++k) {
    is_spike[k] = random() % 20 == 0;
    if (is_spike[k]) x(k, 0) += 2;
    planted += is_spike[k];
  }
  const auto replaced = RemoveSpikes(&x);
  const int found = (replaced.col(0) && is_spike).count();
  EXPECT_GE(found, 0.97 * planted);
  EXPECT_GE(found, 0.99 * replaced.count());
  EXPECT_LT((x - clean).cwiseAbs().mean(), 0.01);
}

TEST(RemoveSpikes, LeavesCleanSignalsAlone) {
  std::mt19937_64 random(2);
  MatrixXd noisy = Noisy(4000, 0.1, &random);
  const MatrixXd before = noisy;
  EXPECT_LE(RemoveSpikes(&noisy).count(), 2);
  // Exact data: steps and smooth peaks, nothing to be 8 deviations from.
  MatrixXd smooth(4000, 1);
  for (int k = 0; k < 4000; ++k) {
    smooth(k, 0) = 10 * std::sin(0.02 * k) + (k > 2000 ? 5 : 0);
  }
  EXPECT_EQ(RemoveSpikes(&smooth).count(), 0);
  MatrixXd constant = MatrixXd::Constant(100, 1, 3);
  constant(50, 0) = 4;  // most samples equal their neighbours: no scale
  EXPECT_EQ(RemoveSpikes(&constant).count(), 0);
  MatrixXd few = MatrixXd::Random(5, 2);
  EXPECT_EQ(RemoveSpikes(&few).count(), 0);
}

// 5 % one-sided outliers of 20 deviations and a run of eleven, where the level
// drifts by 50 and jumps by 30.
TEST(FindOutlying, FindsRunsAndLeavesLevelsAlone) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0, 0.1);
  Eigen::VectorXd clean(4000);
  for (int k = 0; k < 4000; ++k) {
    clean[k] = 5 * std::sin(5e-4 * k) + (k < 2000 ? 0 : 3) + normal(random);
  }
  Eigen::VectorXd x = clean;
  Eigen::Array<bool, Eigen::Dynamic, 1> planted(4000);
  for (int k = 0; k < 4000; ++k) planted[k] = random() % 20 == 0;
  planted.segment(1000, 11) = true;
  planted.head(2) = planted.tail(2) = true;
  for (int k = 0; k < 4000; ++k) x[k] += planted[k] ? 2 : 0;
  const Outlying found = FindOutlying(x, 15, 0);
  EXPECT_TRUE((found.marked == planted).all())
      << (found.marked != planted).count();
  // The level has no part in them: |normal| has mean .8 deviations.
  EXPECT_NEAR((found.level - clean).cwiseAbs().mean(), .08, .005);
}

TEST(FindOutlying, DeviationAndLeastSize) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal(0, 0.1);
  Eigen::VectorXd x(20000);
  for (double& v : x) v = normal(random);
  const Outlying clean = FindOutlying(x, 15, 0);
  EXPECT_EQ(clean.marked.count(), 0);
  EXPECT_NEAR(clean.deviation, .1, .005);
  x[500] += 2;
  EXPECT_EQ(FindOutlying(x, 15, 0).marked.count(), 1);
  EXPECT_EQ(FindOutlying(x, 15, 1).marked.count(), 1);
  EXPECT_EQ(FindOutlying(x, 15, 3).marked.count(), 0);
  x.setConstant(7);
  EXPECT_EQ(FindOutlying(x, 15, 0).marked.count(), 0);
  EXPECT_EQ(FindOutlying(Eigen::VectorXd::Random(5), 15, 0).marked.count(), 0);
}

// By the definition: sort what is not marked of each neighbourhood.
TEST(FindOutlying, LevelsAreMediansOfTheUnmarked) {
  std::mt19937_64 random(6);
  std::normal_distribution<double> normal(0, 0.1);
  Eigen::VectorXd x(700);
  for (double& v : x) v = normal(random) + (random() % 15 == 0 ? 3 : 0);
  x.segment(300, 9).array() += 3;
  const int reach = 15;
  const Outlying found = FindOutlying(x, reach, 0);
  ASSERT_GT(found.marked.count(), 30);
  for (int k = 0; k < x.size(); ++k) {
    std::vector<double> window;
    if (!found.marked[k]) window.push_back(x[k]);
    for (const int step : {-1, 1}) {
      int count = 0;
      for (int j = k + step; j >= 0 && j < x.size() && count < reach;
           j += step) {
        if (!found.marked[j]) window.push_back(x[j]), ++count;
      }
    }
    std::sort(window.begin(), window.end());
    EXPECT_EQ(found.level[k], window[window.size() / 2]) << k;
  }
}

// From one unmarked sample to the next there may be a line, or a step.
TEST(Bridge, AndNearerEndAreOfTheUnmarked) {
  Eigen::VectorXd x(8);
  x << 1, 9, 2, -4, -3, 5, 6, 5.5;
  Eigen::Array<bool, Eigen::Dynamic, 1> marked(8);
  marked << false, true, false, true, true, false, true, false;
  const auto bridge = [&](int k) { return Bridge(x, k, marked); };
  const auto step = [&](int k) { return NearerEnd(x, k, marked); };
  EXPECT_EQ(bridge(1), 1.5);
  EXPECT_EQ(step(1), 2);
  EXPECT_EQ(bridge(4), 4);
  EXPECT_EQ(step(4), 2);
  EXPECT_EQ(bridge(6), 5.25);
  EXPECT_EQ(step(6), 5.5);
  x[4] = 4;
  EXPECT_EQ(step(4), 5);
  marked[0] = marked[7] = true;
  for (const auto& nearest : {bridge(0), step(0)}) EXPECT_EQ(nearest, 2);
  for (const auto& nearest : {bridge(7), step(7)}) EXPECT_EQ(nearest, 5);
  marked.setConstant(true);
  for (const auto& own : {bridge(3), step(3)}) EXPECT_EQ(own, -4);
}

}  // namespace armcal::spikes_test
