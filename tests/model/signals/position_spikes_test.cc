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
