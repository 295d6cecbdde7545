#include "calib/logs/stamp_means.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::stamp_means_test {

using Eigen::VectorXd;

constexpr double kStep = .01;
constexpr int kSize = 1001;

// Stamps that are 1 ms early and late in turn; times that lose 1 % of a second
// in each.
TEST(WithMeansOf, IsTheStampsInTheLargeAndTheTimesInTheSmall) {
  VectorXd truth(kSize), stamps(kSize), t(kSize);
  for (int k = 0; k < kSize; ++k) {
    truth[k] = k * kStep;
    stamps[k] = truth[k] + (k % 2 == 0 ? 1e-3 : -1e-3);
    t[k] = .99 * truth[k];
  }
  const VectorXd moved = WithMeansOf(stamps, t);
  ASSERT_EQ(moved.size(), kSize);
  EXPECT_EQ(moved[0], 0);
  // Half a window beyond an end is missing, over which t loses 2.5 ms.
  EXPECT_LT((moved - truth).cwiseAbs().maxCoeff(), 6e-3);
  for (int k = 51; k < kSize - 51; ++k) {
    EXPECT_NEAR(moved[k + 1] - moved[k], kStep, 5e-5);
  }
}

TEST(WithMeansOf, NeverGoesBack) {
  VectorXd stamps(kSize), t(kSize);
  for (int k = 0; k < kSize; ++k) {
    stamps[k] = k * kStep;
    t[k] = 2 * kStep * std::floor(k / 2.) + .003 * (k % 2) * std::sin(.1 * k);
  }
  const VectorXd moved = WithMeansOf(stamps, t);
  for (int k = 1; k < kSize; ++k) EXPECT_GE(moved[k], moved[k - 1]);
}

}  // namespace armcal::stamp_means_test
