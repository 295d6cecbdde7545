#include "calib/diagnose/data/segment_rate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures/gap_segment.h"
#include "tests/fixtures/swing.h"

namespace armcal::segment_rate_test {

constexpr double kStep = .001;           // s
constexpr double kMotionBandwidth = 50;  // Hz

// Two joints at 1 Hz for 8 s; the torque is the velocity.
GapSegment Swing(double step) {
  Log log = RecordMotion(SwingOfTwoJoints(), 8, step);
  log.tau = log.qd;
  return MakeSegment(log);
}

TEST(DecimateSegment, KeepsEveryFourthSampleAtOneKilohertz) {
  const GapSegment all = Swing(kStep);
  GapSegment kept = all;
  kept.still(8, 1) = true;
  kept.still(9, 1) = true;
  DecimateSegment(kMotionBandwidth, &kept);
  ASSERT_EQ(kept.size(), (all.size() + 3) / 4);
  EXPECT_DOUBLE_EQ(kept.motion.dt, 4 * kStep);
  EXPECT_EQ(kept.tau.rows(), kept.size());
  EXPECT_EQ(kept.motion.torque.tau.rows(), kept.size());
  EXPECT_EQ(kept.still.count(), 1);
  EXPECT_TRUE(kept.still(2, 1));
  for (int k = 0; k < kept.size(); ++k) {
    ASSERT_NEAR(kept.motion.time(k), all.motion.time(4 * k), 1e-12);
    ASSERT_EQ(kept.motion.q.row(k), all.motion.q.row(4 * k));
    ASSERT_EQ(kept.motion.qdd.row(k), all.motion.qdd.row(4 * k));
  }
  // 1 Hz is far below the filter's 50.
  for (int k = 100; k < kept.size() - 100; ++k) {
    ASSERT_NEAR(kept.tau(k, 0), all.tau(4 * k, 0), 1e-6);
  }
}

// A hum of 240 Hz would be one of 10 Hz to those who look at 250 Hz.
TEST(DecimateSegment, FoldsNothingIntoTheBand) {
  GapSegment segment = Swing(kStep);
  const Eigen::MatrixXd clean = segment.tau;
  for (int k = 0; k < segment.size(); ++k) {
    segment.tau(k, 0) += std::sin(2 * M_PI * 240 * k * kStep);
  }
  DecimateSegment(kMotionBandwidth, &segment);
  for (int k = 100; k < segment.size() - 100; ++k) {
    ASSERT_NEAR(segment.tau(k, 0), clean(4 * k, 0), 1e-4);
  }
}

TEST(DecimateSegment, LeavesLogsAloneOfWhichNoSampleIsToSpare) {
  const GapSegment all = Swing(.004);
  GapSegment kept = all;
  DecimateSegment(kMotionBandwidth, &kept);
  EXPECT_EQ(kept.size(), all.size());
  EXPECT_EQ(kept.tau, all.tau);
}

}  // namespace armcal::segment_rate_test
