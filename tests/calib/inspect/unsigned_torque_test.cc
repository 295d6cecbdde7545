#include "calib/inspect/unsigned_torque.h"

#include <gtest/gtest.h>

#include "calib/logs/uniform_series.h"
#include "tests/fixtures/inspected_arm.h"

namespace armcal::unsigned_torque_test {

class UnsignedTorqueTest : public testing::Test {
 protected:
  std::vector<UnsignedTorque> Find(const std::vector<int>& joints) const {
    return FindUnsignedTorques(
        arm_.robot, UniformSeries(arm_.log, .01, .05, 8).Pick(400, 0), joints);
  }
  InspectedArm arm_;
};

TEST_F(UnsignedTorqueTest, ALostSignIsFound) {
  for (const int j : {0, 3, 4, 5}) {
    arm_.log = InspectedArm().log;
    arm_.log.tau.col(j) = arm_.log.tau.col(j).cwiseAbs().eval();
    const auto found = Find({j});
    ASSERT_EQ(found.size(), 1u) << j;
    EXPECT_EQ(found[0].joint, j);
    EXPECT_LT(found[0].after, .7 * found[0].before);
    EXPECT_GT(found[0].turned, .1);
  }
}

// The second joint holds the arm up all the time: its torque has one sign by
// right.
TEST_F(UnsignedTorqueTest, ATorqueOfOneSignIsRight) {
  const Eigen::VectorXd tau = arm_.log.tau.col(1);
  ASSERT_GT(tau.minCoeff() * tau.maxCoeff(), 0);
  EXPECT_TRUE(Find({1}).empty());
}

TEST_F(UnsignedTorqueTest, NoiseHasLostNothing) {
  std::mt19937_64 random(5);
  arm_.log.tau.col(5).setZero();
  AddNoise(&random, Eigen::VectorXd::Ones(6), &arm_.log.tau);
  arm_.log.tau.col(5) = arm_.log.tau.col(5).cwiseAbs().eval();
  EXPECT_TRUE(Find({5}).empty());
}

// No arm explains it, but its size comes to zero again and again without ever
// going on to the other side. Noise that has both signs is not asked; noise
// beside a load does not come near zero.
TEST_F(UnsignedTorqueTest, ASizeThatNoArmExplainsIsToldByItsZeros) {
  std::mt19937_64 random(5);
  arm_.log.tau.col(5).setZero();
  AddNoise(&random, Eigen::VectorXd::Ones(6), &arm_.log.tau);
  arm_.log.tau.col(5) = arm_.log.tau.col(5).cwiseAbs().eval();
  const UniformSeries series(arm_.log, .01, .05, 8);
  const auto told = [&] {
    return UnsignedFindings(arm_.robot, series, arm_.log, series.Pick(400, 0),
                            {5});
  };
  ASSERT_EQ(told().size(), 1u);
  EXPECT_EQ(told()[0].joint, 5);
  EXPECT_NE(told()[0].evidence.find("never on the other side"),
            std::string::npos);
  arm_.log.tau.col(5).array() += 1;
  EXPECT_TRUE(told().empty());
}

}  // namespace armcal::unsigned_torque_test
