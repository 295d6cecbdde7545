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

}  // namespace armcal::held_out_fit_test
