#include "calib/logs/uniform_series.h"

#include <gtest/gtest.h>

#include "tests/fixtures/inspected_arm.h"

namespace armcal::uniform_series_test {

TEST(UniformSeries, IsTheMotionAndItsDerivatives) {
  const InspectedArm arm("2R planar (vertical plane)", 10);
  const UniformSeries series(arm.log, .01, .05, 10);
  ASSERT_EQ(series.motion().size(), arm.log.size());
  double worst = 0;
  for (const int s : series.moving()) {
    worst = std::max(worst,
                     (series.motion().qdd.row(s) - arm.log.qdd.row(s)).norm());
  }
  EXPECT_LT(worst, .02 * arm.log.qdd.cwiseAbs().maxCoeff());
}

TEST(UniformSeries, PickedTorquesAreLater) {
  const InspectedArm arm("2R planar (vertical plane)", 10);
  const UniformSeries series(arm.log, .01, .05, 10);
  const WiringSamples now = series.Pick(1 << 20, 0);
  const WiringSamples later = series.Pick(1 << 20, .03);
  const Eigen::Index size = now.tau.rows() - 3;
  EXPECT_EQ(now.motion.q, later.motion.q);
  EXPECT_LT((later.tau.topRows(size) - now.tau.bottomRows(size)).norm(),
            1e-9 * now.tau.norm());
}

// Neither stretches across gaps nor an arm at rest.
TEST(UniformSeries, LeavesOutGapsAndStandstill) {
  InspectedArm arm("2R planar (vertical plane)", 10);
  const int whole = UniformSeries(arm.log, .01, .05, 10).num_moving();
  arm.log.t.tail(500).array() += 2;
  EXPECT_LT(UniformSeries(arm.log, .01, .05, 10).num_moving(), whole);
  InspectedArm still("2R planar (vertical plane)", 10);
  still.log.q.bottomRows(500).rowwise() = still.log.q.row(501).eval();
  EXPECT_LT(UniformSeries(still.log, .01, .05, 10).num_moving(), .6 * whole);
}

}  // namespace armcal::uniform_series_test
