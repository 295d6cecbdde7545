#include "calib/inspect/columns/folded_torque.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::folded_torque_test {

using Eigen::VectorXd;

constexpr int kRows = 4000;

// 20 periods in phase `x`, 2 pi each.
VectorXd Phase() { return VectorXd::LinSpaced(kRows, .1, .1 + 40 * M_PI); }
Folds Of(const VectorXd& torque) {
  return FindFolds(torque, VectorXd::Ones(kRows));
}

// |sin| has two visits a period, but those before it was away from zero. Of
// phases below 5/30 rms = 5/30 sqrt(1/2) those below rms/30 are a fifth, as the
// sine is all but straight there.
TEST(FoldedTorqueTest, TheSizeOfASineComesToZeroTwiceAPeriod) {
  const Folds folds = Of(Phase().array().sin().abs());
  EXPECT_NEAR(folds.visits, 40, 1);
  EXPECT_NEAR(folds.share, .2, .02);
  EXPECT_TRUE(folds.HaveLostSign(6, 0));
}

// 1 + sin turns at zero: values near it are as the root, sqrt(1/5) of them.
TEST(FoldedTorqueTest, WhatTurnsAtZeroHasNotLostASign) {
  const Folds folds = Of(1 + Phase().array().sin());
  EXPECT_NEAR(folds.visits, 20, 1);
  EXPECT_NEAR(folds.share, std::sqrt(.2), .05);
  EXPECT_FALSE(folds.HaveLostSign(1, 2));
}

// A drive that only pulls rests at zero for half of the time.
TEST(FoldedTorqueTest, WhatRestsAtZeroHasNotLostASign) {
  const Folds folds = Of(Phase().array().sin().max(0));
  EXPECT_GT(folds.visits, 15);
  EXPECT_FALSE(folds.HaveLostSign(1, 2));
}

TEST(FoldedTorqueTest, WhatHoldsALoadDoesNotComeNear) {
  EXPECT_EQ(Of(1.5 + Phase().array().sin()).visits, 0);
}

// Seven visits are one column in 128, eight are one in 256: of two columns that
// were asked eight tell, of one seven. What agrees counts as a visit each.
TEST(FoldedTorqueTest, VisitsAreASignTest) {
  Folds folds{7, .2};
  EXPECT_TRUE(folds.HaveLostSign(1, 0));
  EXPECT_FALSE(folds.HaveLostSign(2, 0));
  EXPECT_TRUE(folds.HaveLostSign(2, 1));
  folds.visits = 4;
  EXPECT_FALSE(folds.HaveLostSign(1, 9));
}

// Where the joint rests nothing is asked.
TEST(FoldedTorqueTest, RowsAtRestDoNotCount) {
  VectorXd speed = VectorXd::Ones(kRows);
  speed.head(kRows / 2).setZero();
  EXPECT_NEAR(FindFolds(Phase().array().sin().abs(), speed).visits, 20, 1);
}

}  // namespace armcal::folded_torque_test
