#include "calib/diagnose/select/returning_events.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::returning_events_test {

using Eigen::MatrixXd;

constexpr double kStep = .01, kPeriod = 5, kBandwidth = 6;
constexpr int kSize = 2000;  // samples: 20 s

// Two joints that repeat a motion of 5 s four times, or drift away from where
// they were. What is left of the second one's torque are pulses of .6 s.
class ReturningEventsTest : public testing::Test {
 protected:
  explicit ReturningEventsTest(double drift = 0) {
    Motion motion;
    motion.dt = kStep;
    motion.q.resize(kSize, 2);
    motion.qd.resize(kSize, 2);
    motion.qdd.setZero(kSize, 2);
    for (int k = 0; k < kSize; ++k) {
      const double w = 2 * M_PI / kPeriod, t = k * kStep;
      motion.q.row(k) << std::sin(w * t) + drift * t, .5 * std::sin(2 * w * t);
      motion.qd.row(k) << w * std::cos(w * t) + drift, w * std::cos(2 * w * t);
    }
    segments_ = {MakeSegment(motion, MatrixXd::Zero(kSize, 2))};
  }
  // With pulses of these sizes at these times, of that at 7 s.
  double Share(const std::vector<std::pair<double, double>>& pulses) const {
    const GapRows rows(segments_, kBandwidth);
    MatrixXd left = MatrixXd::Zero(rows.num_thin(), 2);
    for (int k = 0; k < rows.num_thin(); ++k) {
      for (const auto& [time, size] : pulses) {
        const double s = (rows.thin_time(0, k) - time) / .15;
        left(k, 1) += size * std::exp(-s * s);
      }
    }
    GapEvent event;
    event.contact.window = {6.7, 7.3};
    event.contact.time = 7;
    event.contact.joint = 1;
    const Returning torque = ReturningTorque(rows, left, event);
    return torque.returned / torque.own;
  }

  std::vector<GapSegment> segments_;
};

class NeverAgainTest : public ReturningEventsTest {
 protected:
  NeverAgainTest() : ReturningEventsTest(.5) {}
};

TEST_F(ReturningEventsTest, ALawReturnsWithTheMotion) {
  EXPECT_NEAR(Share({{2, 1}, {7, 1}, {12, 1}, {17, 1}}), 1, .05);
  EXPECT_NEAR(Share({{2, .4}, {7, 1}, {12, .3}, {17, .2}}), .3, .05);
}

// A third joint rests, and its position is noise.
TEST_F(ReturningEventsTest, AJointThatRestsIsInNoState) {
  Motion& motion = segments_[0].motion;
  motion.q.conservativeResize(kSize, 3);
  motion.qd.conservativeResize(kSize, 3);
  motion.qdd.setZero(kSize, 3);
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0, 1e-5);
  for (int k = 0; k < kSize; ++k) {
    motion.q(k, 2) = noise(random);
    motion.qd(k, 2) = noise(random);
  }
  segments_ = {MakeSegment(motion, MatrixXd::Zero(kSize, 3))};
  EXPECT_NEAR(Share({{2, 1}, {7, 1}, {12, 1}, {17, 1}}), 1, .05);
}

TEST_F(ReturningEventsTest, ATouchDoesNot) {
  EXPECT_NEAR(Share({{7, 1}}), 0, .01);
  // Nor do others, at other times or the other way.
  EXPECT_NEAR(Share({{7, 1}, {11, 1}, {15.5, 1}}), 0, .05);
  EXPECT_LT(Share({{2, -1}, {7, 1}}), -.3);
}

// Pulses as far apart as the periods of a motion that is not repeated.
TEST_F(NeverAgainTest, WhatCannotReturnIsATouch) {
  EXPECT_EQ(Share({{2, 1}, {7, 1}, {12, 1}, {17, 1}}), 0);
}

// A 2R arm that repeats a motion of 8 s three times; pushes of 4 N m on the
// first joint, 3 s into these periods.
size_t PushesLeft(const std::vector<int>& periods) {
  const EffectArm arm("2R planar (vertical plane)", 8, .01);
  const GapBaseline baseline(arm.robot, {}, Eigen::VectorXd::Constant(2, 10));
  Motion motion = arm.motion;
  const auto repeated = [](const MatrixXd& once) {
    return MatrixXd(once.replicate(3, 1));
  };
  motion.q = repeated(arm.motion.q);
  motion.qd = repeated(arm.motion.qd);
  motion.qdd = repeated(arm.motion.qdd);
  motion.stamp_error.resize(0);
  MatrixXd tau =
      RecordedTorque(arm.robot, baseline.transitions(), motion).nominal();
  std::mt19937_64 random(4);
  const auto record = [&](const std::vector<int>& pushed) {
    MatrixXd noisy = tau;
    AddNoise(&random, Eigen::VectorXd::Constant(2, .05), &noisy);
    for (int k = 0; k < motion.size(); ++k) {
      for (const int period : pushed) {
        const double s = (k * motion.dt - 8 * period - 3) / .15;
        noisy(k, 0) += 4 * std::exp(-s * s);
      }
    }
    return MakeSegment(motion, noisy);
  };
  GapSegment reference = record({});
  reference.log = 1;
  GapRegression regression(baseline, kBandwidth, {record(periods)},
                           {reference});
  regression.Refit();
  std::vector<GapEvent> events;
  for (const int period : periods) {
    const double time = 8 * period + 3;
    GapEvent event;
    event.contact.window = {time - .3, time + .3};
    event.contact.time = time;
    event.pulse = true;
    events.push_back(event);
  }
  return WithoutReturning(regression, {}, events).size();
}

// As much as before is a law's, and nothing a touch's; which is nearer, a law
// foretells of many together.
TEST(Returns, IsNearerToAllOfItThanToNothing) {
  for (const double back : {.6, 1., 1.4}) {
    EXPECT_TRUE(Returns({{-3, -3 * back, 1}})) << back;
  }
  for (const double back : {-1., 0., .4, 1.6, 2.2}) {
    EXPECT_FALSE(Returns({{-3, -3 * back, 1}})) << back;
  }
  EXPECT_FALSE(Returns({}));
  EXPECT_TRUE(Returns({{6, 6, 2}, {-5, -5, 2}, {1, 0, 1}}));
  EXPECT_FALSE(Returns({{6, 6, 2}, {-5, 0, 2}, {1, 1, 1}}));
}

TEST(WithoutReturning, LeavesWhatActsOnceInAPeriodicMotion) {
  EXPECT_EQ(PushesLeft({1}), 1u);
  EXPECT_EQ(PushesLeft({0, 1, 2}), 0u);
}

}  // namespace armcal::returning_events_test
