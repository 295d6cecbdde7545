#include "calib/logs/velocity_delay.h"

#include <gtest/gtest.h>

#include "tests/fixtures/inspected_arm.h"

namespace armcal::velocity_delay_test {

class VelocityDelayTest : public testing::Test {
 protected:
  // Joint j's velocity as it was `rows` rows of 10 ms before.
  void MakeLate(int j, int rows) {
    const Eigen::VectorXd qd = log_.qd.col(j);
    for (int k = 0; k < log_.size(); ++k)
      log_.qd(k, j) = qd[std::max(0, k - rows)];
  }
  Log log_ = InspectedArm().log;
};

TEST_F(VelocityDelayTest, OfALateVelocity) {
  MakeLate(2, 3);
  const auto delay = VelocityDelay(log_, 2);
  ASSERT_TRUE(delay);
  EXPECT_NEAR(*delay, .03, .003);
  EXPECT_FALSE(VelocityDelay(log_, 1));
}

TEST_F(VelocityDelayTest, ASmallDelayIsNone) {
  MakeLate(2, 1);
  EXPECT_FALSE(VelocityDelay(log_, 2));
}

TEST_F(VelocityDelayTest, NoiseAtRestHasNone) {
  std::mt19937_64 random(3);
  log_.q.col(0).setConstant(.3);
  log_.qd.col(0).setZero();
  const Eigen::VectorXd sigma = Eigen::VectorXd::Constant(log_.q.cols(), 1e-4);
  AddNoise(&random, sigma, &log_.q);
  AddNoise(&random, 100 * sigma, &log_.qd);
  EXPECT_FALSE(VelocityDelay(log_, 0));
}

TEST_F(VelocityDelayTest, AScaleIsNone) {
  log_.qd.col(1) *= 1.2;
  EXPECT_FALSE(VelocityDelay(log_, 1));
}

// 12 Hz turns round within the stretches of 50 ms that are compared.
TEST_F(VelocityDelayTest, OfAWobble) {
  for (int k = 0; k < log_.size(); ++k) {
    const double phase = 2 * M_PI * 12 * log_.t[k];
    log_.q(k, 2) += .01 * std::sin(phase);
    log_.qd(k, 2) += .01 * 2 * M_PI * 12 * std::cos(phase);
  }
  EXPECT_FALSE(VelocityDelay(log_, 2));
  MakeLate(2, 3);
  const auto delay = VelocityDelay(log_, 2);
  ASSERT_TRUE(delay);
  EXPECT_NEAR(*delay, .03, .003);
}

// A delay that is longer than what is searched has no least value in it.
TEST_F(VelocityDelayTest, BeyondWhatIsSearched) {
  MakeLate(2, 20);
  EXPECT_FALSE(VelocityDelay(log_, 2));
}

}  // namespace armcal::velocity_delay_test
