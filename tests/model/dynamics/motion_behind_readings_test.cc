#include "model/dynamics/motion_behind_readings.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::motion_behind_readings_test {

using Eigen::VectorXd;

// A joint that swings evenly, as a log has it whose stamps are late by e.
TEST(MotionBehindReadings, UnevenStampsAreThoseOfTheClock) {
  constexpr int kSamples = 2000;
  constexpr double kStep = .01, kSize = .03;  // s
  Motion recorded;
  recorded.dt = kStep;
  recorded.q.resize(kSamples, 1);
  recorded.qd = recorded.qdd = recorded.q;
  recorded.stamp_error.resize(kSamples);
  Motion truth = recorded;
  VectorXd times(kSamples);
  for (int k = 0; k < kSamples; ++k) {
    const double s = k * kStep, w = 2 * M_PI / 8;
    const double e = kSize * std::sin(w * s), de = kSize * w * std::cos(w * s);
    const double dde = -w * w * e, t = s - e;
    times[k] = t;
    recorded.stamp_error[k] = e;
    truth.q(k, 0) = recorded.q(k, 0) = std::sin(3 * t);
    truth.qd(k, 0) = 3 * std::cos(3 * t);
    truth.qdd(k, 0) = -9 * std::sin(3 * t);
    recorded.qd(k, 0) = (1 - de) * truth.qd(k, 0);
    recorded.qdd(k, 0) =
        (1 - de) * (1 - de) * truth.qdd(k, 0) - dde * truth.qd(k, 0);
  }
  SimulatedRobot changed;
  MotionTrack track;
  track.SetMotion(recorded);
  Motion motion;
  VectorXd true_times;
  EXPECT_FALSE(
      MotionBehindReadings(changed, recorded, track, &motion, &true_times));
  changed.clock_unevenness = 1;
  ASSERT_TRUE(
      MotionBehindReadings(changed, recorded, track, &motion, &true_times));
  EXPECT_LT((motion.qd - truth.qd).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT((motion.qdd - truth.qdd).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LT((true_times - times).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace armcal::motion_behind_readings_test
