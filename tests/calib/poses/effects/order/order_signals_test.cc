#include "calib/poses/effects/order/order_signals.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::order_signals_test {

TEST(OrderSignals, AreOneWithinTheirPoses) {
  PosePlace place;
  place.begin = 2;
  Eigen::VectorXd step(5);
  step << 0, 0, 1, 1, 1;
  EXPECT_EQ(WindowSignal(5, place), step);
  place.end = 4;
  step[4] = 0;
  EXPECT_EQ(WindowSignal(5, place), step);
}

// Hat functions add up to 1 from the second knot on, and draw any line.
TEST(OrderSignals, DriftFollowsACubicThroughItsKnots) {
  const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(31, 0, 1);
  PosePlace place;
  place.knots = 4;
  const Eigen::ArrayXd cubic = t * (2 - 3 * t + 4 * t.square());
  const Eigen::Vector3d at_knots(cubic[10], cubic[20], cubic[30]);
  const Eigen::MatrixXd signals = DriftSignals(31, place);
  ASSERT_EQ(signals.cols(), 3);
  EXPECT_LT((signals * at_knots - cubic.matrix()).norm(), 1e-13);
  place.knots = 2;
  EXPECT_LT((DriftSignals(31, place) - t.matrix()).norm(), 1e-14);
  place.knots = 1;
  EXPECT_NEAR(DriftSignals(9, place)(8, 0), 1 - std::exp(-4), 1e-14);
}

TEST(PoseEffects, AreThereWithAllThatOthersAsk) {
  for (const PoseEffect& effect : PoseEffects()) {
    SCOPED_TRACE(effect.name);
    EXPECT_FALSE(effect.means.empty());
    EXPECT_FALSE(effect.separate_by.empty());
    EXPECT_NE(effect.places, nullptr);
    EXPECT_NE(effect.terms, nullptr);
  }
}

}  // namespace armcal::order_signals_test
