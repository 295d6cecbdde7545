#include "calib/inspect/held_out_fit.h"

#include <gtest/gtest.h>

#include "calib/logs/uniform_series.h"
#include "tests/fixtures/inspected_arm.h"

namespace armcal::held_out_fit_test {

class HeldOutFitTest : public testing::Test {
 protected:
  HeldOutFit Fit(const Log& log) const {
    return FitHeldOut(arm_.robot, UniformSeries(log, .01, .05, 8).Pick(400, 0));
  }
  InspectedArm arm_;
};

// Noise of 1 % of each torque, low-passed, is what is left.
TEST_F(HeldOutFitTest, LeavesTheNoise) {
  const HeldOutFit fit = Fit(arm_.log);
  EXPECT_LT(fit.residual_percent, 5);
  EXPECT_GT(fit.all.minCoeff(), 0);
  // What was fitted to leaves no more than what was not.
  EXPECT_LE(fit.all[2], fit.all.head<2>().maxCoeff());
}

TEST_F(HeldOutFitTest, AWrongSignIsClear) {
  Log wrong = arm_.log;
  wrong.tau.col(3) *= -1;
  EXPECT_TRUE(IsClearlyBetter(Fit(wrong), Fit(arm_.log), {3}));
  EXPECT_FALSE(IsClearlyBetter(Fit(arm_.log), Fit(wrong), {3}));
}

// A fit that is better by a little, as any other is, says nothing.
TEST_F(HeldOutFitTest, ALittleIsNotClear) {
  HeldOutFit as_is = Fit(arm_.log), changed = as_is;
  changed.joints *= .6;
  changed.all *= .6;
  changed.residual_percent *= .8;
  EXPECT_FALSE(IsClearlyBetter(as_is, changed, {3}));
  EXPECT_FALSE(IsClearlyBetter(as_is, changed, {}));
  // Nor does one that is far better in one half alone.
  changed = as_is;
  changed.joints.row(0) *= .01;
  changed.residual_percent *= .8;
  EXPECT_FALSE(IsClearlyBetter(as_is, changed, {3}));
}

TEST_F(HeldOutFitTest, ADelayConcernsAllJoints) {
  Log late = arm_.log;
  const Eigen::Index size = late.tau.rows() - 3;
  late.tau.bottomRows(size) = arm_.log.tau.topRows(size);
  const HeldOutFit as_is = Fit(late), right = Fit(arm_.log);
  EXPECT_TRUE(IsBetterForAll(as_is, right));
  EXPECT_FALSE(IsBetterForAll(right, as_is));
  HeldOutFit one_worse = right;
  one_worse.joints.col(2) = 2 * as_is.joints.col(2);
  EXPECT_FALSE(IsBetterForAll(as_is, one_worse));
}

// The sign of one joint has to mend its own torque and all together; what
// others leave is as it was.
TEST_F(HeldOutFitTest, OneSignIsAskedOfItsOwnTorque) {
  HeldOutFit as_is = Fit(arm_.log);
  as_is.joints.setConstant(.1);
  as_is.all.setConstant(.1);
  HeldOutFit changed = as_is;
  changed.joints.col(3) << .07, .05, .05;  // one half by less than 1.5
  changed.all << .07, .05, .05;
  EXPECT_TRUE(IsBetterSign(as_is, changed, 3));
  EXPECT_FALSE(IsBetterSign(as_is, changed, 2));
  // Not in its own torque alone, nor where one half says no.
  HeldOutFit other = changed;
  other.all.setConstant(.08);
  EXPECT_FALSE(IsBetterSign(as_is, other, 3));
  other = changed;
  other.joints.col(3) << .11, .01, .05;
  EXPECT_FALSE(IsBetterSign(as_is, other, 3));
}

// What torques 2 and 4 leave is theirs, whichever joint they are read as.
TEST_F(HeldOutFitTest, FiguresAreOfColumns) {
  HeldOutFit exchanged = Fit(arm_.log);
  exchanged.joints.row(0) << 1, 2, 3, 4, 5, 6;
  exchanged.variation << 1, 2, 3, 4, 5, 6;
  const HeldOutFit columns = OfColumns(exchanged, {0, 3, 2, 1, 4, 5});
  Eigen::RowVectorXd expected(6);
  expected << 1, 4, 3, 2, 5, 6;
  EXPECT_EQ(columns.joints.row(0), expected);
  EXPECT_EQ(columns.variation, expected.transpose());
}

// Two thirds of all torques' squares, in each half and in the whole.
TEST_F(HeldOutFitTest, AllTorquesAreBetterByAThird) {
  HeldOutFit as_is = Fit(arm_.log), changed = as_is;
  as_is.all << .1, .1, .1;
  changed.all << .05, .06, .065;
  EXPECT_TRUE(IsBetterInTotal(as_is, changed));
  changed.all[1] = .07;
  EXPECT_FALSE(IsBetterInTotal(as_is, changed));
}

// A joint slows down and holds on, with all of its friction one way or the
// other: nothing of that is asked.
TEST_F(HeldOutFitTest, WhatFrictionHoldsAtRestIsNotAsked) {
  Log log = arm_.log;
  const double rms = ColumnRms(log.tau)[5];
  for (int k = 0; k < log.size(); ++k) {
    if (std::abs(log.qd(k, 5)) < .1 * ColumnRms(log.qd)[5]) {
      log.tau(k, 5) = k / 8 % 2 == 0 ? rms : -rms;
    }
  }
  EXPECT_LT(Fit(log).joints(2, 5), .003);
}

// As it is nothing of how the torque varies is explained, then all of it: this
// tells a sign where the joint has a tenth of all torques.
TEST_F(HeldOutFitTest, TheFirstThatExplains) {
  Log wrong = arm_.log;
  wrong.tau.col(5) *= -1;
  const HeldOutFit as_is = Fit(wrong), right = Fit(arm_.log);
  EXPECT_TRUE(IsFirstToExplain(as_is, right, 5));
  EXPECT_FALSE(IsFirstToExplain(right, as_is, 5));
  EXPECT_FALSE(IsFirstToExplain(as_is, right, 1));
}

// Half of next to nothing is nothing: no model is that good.
TEST_F(HeldOutFitTest, HalfOfNothingIsNotClear) {
  HeldOutFit as_is = Fit(arm_.log), changed = as_is;
  as_is.all.setConstant(2e-5);
  changed.all.setConstant(5e-6);
  changed.residual_percent = .5 * as_is.residual_percent;
  EXPECT_FALSE(IsClearlyBetter(as_is, changed, {}));
  as_is.all.setConstant(2e-3);
  changed.all.setConstant(5e-4);
  EXPECT_TRUE(IsClearlyBetter(as_is, changed, {}));
}

}  // namespace armcal::held_out_fit_test
