#include "model/log_files/motion_frequency.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::motion_frequency_test {

// 20 s of two joints at 100 Hz; the first one's sine is the faster.
Eigen::MatrixXd Sines(double hz) {
  Eigen::MatrixXd q(2000, 2);
  for (int k = 0; k < 2000; ++k) {
    q.row(k) << .5 * std::sin(2 * M_PI * hz * .01 * k),
        .2 * std::sin(.6 * M_PI * hz * .01 * k);
  }
  return q;
}

double HzOf(const Eigen::MatrixXd& q) {
  MotionFrequency frequency;
  for (int k = 0; k < q.rows(); ++k) frequency.Add(.01 * k, q, k);
  return frequency.Hz();
}

TEST(MotionFrequency, IsThatOfTheFastestJoint) {
  EXPECT_NEAR(HzOf(Sines(.4)), .4, .004);
  EXPECT_NEAR(HzOf(Sines(2)), 2, .03);
  EXPECT_EQ(HzOf(Eigen::MatrixXd::Constant(500, 2, 1.2)), 0);
}

// One row of no measurement would make it several times as fast, and rows that
// a calibration needs would count as not excited beside such a motion.
TEST(MotionFrequency, RowsOfNoMeasurementDoNotCount) {
  for (const int row : {0, 800}) {
    Eigen::MatrixXd q = Sines(.4);
    q.row(row).setConstant(-M_PI);
    EXPECT_NEAR(HzOf(q), HzOf(Sines(.4)), .004) << row;
  }
}

// Turns are excursions, too, but none that is faster than the motion.
TEST(MotionFrequency, TurnsOfTheMotionCount) {
  Eigen::MatrixXd q(2000, 1);
  for (int k = 0; k < 2000; ++k) q(k, 0) = k / 4 % 2 == 0 ? 0 : .3;
  // Without them it would stand still.
  EXPECT_GT(HzOf(q), 8);
}

}  // namespace armcal::motion_frequency_test
