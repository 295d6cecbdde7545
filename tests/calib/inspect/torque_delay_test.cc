#include "calib/inspect/torque_delay.h"

#include <gtest/gtest.h>

#include "calib/logs/uniform_series.h"
#include "tests/fixtures/inspected_arm.h"

namespace armcal::torque_delay_test {

using Eigen::MatrixXd;

class TorqueDelayTest : public testing::Test {
 protected:
  // The torque of joint j is recorded that many rows of 10 ms later.
  void MakeLate(int j, int rows) {
    const Eigen::VectorXd tau = arm_.log.tau.col(j);
    for (int k = 0; k < arm_.log.size(); ++k) {
      arm_.log.tau(k, j) = tau[std::clamp(k - rows, 0, arm_.log.size() - 1)];
    }
  }
  TorqueDelay Find() const {
    const UniformSeries series(arm_.log, .01, .05, 8);
    const TorqueFit fit(arm_.robot, series.Pick(250, 0).motion);
    return FindTorqueDelay(
        fit, [&](double delay) { return series.Pick(250, delay).tau; }, asked_);
  }

  InspectedArm arm_;
  std::vector<bool> asked_ = std::vector<bool>(6, true);
};

TEST_F(TorqueDelayTest, NoneIsNone) {
  const TorqueDelay none = Find();
  EXPECT_TRUE(none.known);
  EXPECT_NEAR(none.mean, 0, .003);
  EXPECT_FALSE(none.IsBeyond(.005));
}

TEST_F(TorqueDelayTest, AllJointsAreLate) {
  for (int j = 0; j < 6; ++j) MakeLate(j, 3);
  const TorqueDelay late = Find();
  EXPECT_NEAR(late.mean, .03, .003);
  EXPECT_TRUE(late.IsBeyond(.0125));
}

TEST_F(TorqueDelayTest, AllJointsAreEarly) {
  for (int j = 0; j < 6; ++j) MakeLate(j, -3);
  EXPECT_NEAR(Find().mean, -.03, .003);
}

// The best of all together is of most joints; but joints that are 70 ms apart
// do not say when the torques were recorded.
TEST_F(TorqueDelayTest, JointsThatAreApartSayNothing) {
  for (int j = 0; j < 6; ++j) MakeLate(j, j % 2 == 0 ? 5 : -2);
  const TorqueDelay apart = Find();
  EXPECT_GT(apart.stddev, .01);
  EXPECT_FALSE(apart.IsBeyond(.0125));
}

TEST_F(TorqueDelayTest, FewOfManyDoNotTell) {
  for (int j = 0; j < 6; ++j) MakeLate(j, j < 3 ? 3 : 12);
  EXPECT_FALSE(Find().known);
  asked_ = {true, true, true, false, false, false};
  EXPECT_TRUE(Find().known);
}

TEST_F(TorqueDelayTest, BeyondWhatIsSearchedIsNotKnown) {
  for (int j = 0; j < 6; ++j) MakeLate(j, 12);
  EXPECT_FALSE(Find().known);
}

// A joint about an upright axis at 1 rad/s, which turns round so many times in
// 4 s: between that its torque is constant, and any delay fits.
class TurningJointTest : public TorqueDelayTest {
 protected:
  TurningJointTest() {
    arm_ = InspectedArm("PUMA560 6R", 4, 1);
    asked_ = {true};
  }
  void Turn(int times) {
    const double period = 4. / times;
    for (int k = 0; k < arm_.log.size(); ++k) {
      const double phase = M_PI * (arm_.log.t[k] / period - .5);
      const double slope = std::tanh(std::cos(phase + M_PI / 2) * -9);
      arm_.log.qd(k, 0) = slope;
      arm_.log.q(k, 0) = k > 0 ? arm_.log.q(k - 1, 0) + .01 * slope : 0;
      arm_.log.tau(k, 0) = 2 * slope;
    }
    std::mt19937_64 random(3);
    AddNoise(&random, .02 * Eigen::VectorXd::Ones(1), &arm_.log.tau);
    MakeLate(0, 3);
  }
};

TEST_F(TurningJointTest, ManyTurnsTell) {
  Turn(12);
  const TorqueDelay late = Find();
  EXPECT_TRUE(late.is_alone);
  EXPECT_NEAR(late.mean, .03, .01);
  EXPECT_TRUE(late.IsBeyond(.0125));
}

TEST_F(TurningJointTest, OneTurnDoesNot) {
  Turn(1);
  EXPECT_FALSE(Find().IsBeyond(.0125));
}

}  // namespace armcal::torque_delay_test
