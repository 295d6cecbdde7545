#include "model/signals/position_spikes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/signals/resampler.h"

namespace armcal::position_spikes_test {

using Eigen::VectorXd;

// Two sines at 100 Hz, with stamps that jitter by 2 ms.
class PositionSpikesTest : public testing::Test {
 protected:
  PositionSpikesTest() : t_(3000), q_(3000) {
    for (int k = 0; k < 3000; ++k) {
      t_[k] = .01 * k + .002 * std::sin(5. * k);
      q_[k] = .8 * std::sin(2 * t_[k]) + .3 * std::sin(7 * t_[k]);
    }
  }
  long Removed(VectorXd* q) const { return RemovePositionSpikes(t_, *q); }

  VectorXd t_, q_;
};

TEST_F(PositionSpikesTest, MotionStaysAsItIs) {
  VectorXd q = q_;
  EXPECT_EQ(Removed(&q), 0);
  EXPECT_EQ(q, q_);
  // At rest at both ends, and of an encoder of 4096 lines.
  for (int k = 0; k < 3000; ++k) {
    const double x = std::min(1., std::max(0., (t_[k] - 14) / 2));
    const double way = x * x * x * (10 - 15 * x + 6 * x * x);
    q[k] = std::round(way * 4096 / (2 * M_PI)) * 2 * M_PI / 4096;
  }
  const VectorXd rounded = q;
  EXPECT_EQ(Removed(&q), 0);
  EXPECT_EQ(q, rounded);
}

TEST_F(PositionSpikesTest, WhatComesBackIsBridged) {
  VectorXd q = q_;
  q[500] += .8;
  q.segment(900, 3).array() -= 1;
  q[1700] = 12;
  EXPECT_EQ(Removed(&q), 5);
  // A parabola's sagitta over .05 s at 20 rad/s^2.
  EXPECT_LT((q - q_).cwiseAbs().maxCoeff(), 20 * .05 * .05 / 8);
  EXPECT_EQ(Removed(&q), 0);
}

// What does not come back, or after more than a tenth of a second, may be so.
TEST_F(PositionSpikesTest, WhatStaysStays) {
  VectorXd q = q_;
  q.tail(1500).array() += .7;
  q.segment(600, 40).array() += .7;
  const VectorXd moved = q;
  EXPECT_EQ(Removed(&q), 0);
  EXPECT_EQ(q, moved);
}

// A logger that starts, or comes back after a hole, with rows of no
// measurement: they have nothing to come back from.
TEST_F(PositionSpikesTest, TheFirstAndLastRowsOfAStretchAreAskedToo) {
  VectorXd q = q_;
  q[0] -= 2;
  q.tail(2).array() += 3;
  EXPECT_EQ(Removed(&q), 3);
  // A parabola that is left two rows before its end, at 20 rad/s^2.
  EXPECT_LT((q - q_).cwiseAbs().maxCoeff(), 20 * .03 * .03);
  // In a window that slides they may be the first rows of anything.
  q[0] -= 2;
  q[2999] += 3;
  EXPECT_EQ(FindSpikes(t_, q, {true, false}).size(), 1u);
  EXPECT_EQ(FindSpikes(t_, q, {false, true}).size(), 1u);
  t_.tail(2000).array() += .6;  // a hole
  q = q_;
  q[1000] = -M_PI;
  EXPECT_EQ(Removed(&q), 1);
  EXPECT_NEAR(q[1000], q_[1000], .05);
}

TEST_F(PositionSpikesTest, AShortStretchShowsThemToo) {
  for (const int first : {0, 30}) {
    for (const int rows : {1, 3}) {
      VectorXd q = q_.head(80);
      q.segment(first, rows).setConstant(-M_PI);
      EXPECT_EQ(RemovePositionSpikes(t_.head(80), q), rows);
    }
  }
}

TEST_F(PositionSpikesTest, RowsOfTwoJointsAreWrong) {
  EXPECT_TRUE(WrongRows({{{5, 6}}, {{7, 8}}, {}}).empty());
  const auto rows = WrongRows({{{5, 6}, {9, 12}}, {}, {{5, 6}, {10, 13}}});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].begin, 5);
  EXPECT_EQ(rows[0].end, 6);
  EXPECT_EQ(rows[1].begin, 10);
  EXPECT_EQ(rows[1].end, 12);
}

// Of one joint's spike the torque is as good as ever; of a row of no
// measurement it is none.
TEST_F(PositionSpikesTest, ARowThatIsWrongHasNoTorqueEither) {
  Log log;
  log.t = t_;
  log.q.resize(3000, 2);
  log.q << q_, -q_;
  log.tau = log.q.array() + 5;
  log.q(900, 0) = log.tau(900, 0) = 9;
  log.q.row(1234).setConstant(-M_PI);
  log.tau.row(1234).setZero();
  Resampler resampler(.01, false);
  resampler.Append(log, 0, 3000);
  const auto removed = resampler.RemovePositionSpikes();
  EXPECT_EQ(removed[0], 2);
  EXPECT_EQ(removed[1], 1);
  Log mended;
  resampler.Sample(0, 2990, &mended);
  EXPECT_GT(mended.tau.minCoeff(), 3.5);
  EXPECT_GT(mended.tau.maxCoeff(), 7);
}

// Before samples are interpolated: a cubic would spread it over four.
TEST_F(PositionSpikesTest, AResamplerTakesThemOut) {
  Log log;
  log.t = t_;
  log.q = q_;
  log.tau = q_;
  Resampler clean(.01, false), spoilt(.01, false);
  clean.Append(log, 0, 3000);
  log.q(1234, 0) += .5;
  spoilt.Append(log, 0, 3000);
  EXPECT_EQ(clean.RemovePositionSpikes()[0], 0);
  EXPECT_EQ(spoilt.RemovePositionSpikes()[0], 1);
  Log expected, mended;
  clean.Sample(0, 2990, &expected);
  spoilt.Sample(0, 2990, &mended);
  EXPECT_LT((mended.q - expected.q).cwiseAbs().maxCoeff(), 2e-3);
}

}  // namespace armcal::position_spikes_test
