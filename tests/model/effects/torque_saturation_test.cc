#include <gtest/gtest.h>

#include <vector>

#include "model/effects/effects.h"

namespace armcal::torque_saturation_test {

// Limits that are tried where a joint's torque is at most `top`, N m, and 10
// N m as a rule.
std::vector<double> Limits(double top, double usual = 10) {
  Robot robot;
  robot.links.resize(1);
  MotionScale scale;
  scale.torque = Eigen::VectorXd::Constant(1, usual);
  scale.top_torque = Eigen::VectorXd::Constant(1, top);
  return FindEffect("torque_saturation")
      ->parameters[1]
      .grid({&robot, 0, &scale});
}

TEST(TorqueSaturation, IsLookedForWithinWhatWasAskedFor) {
  const std::vector<double> limits = Limits(20);
  EXPECT_NEAR(limits.front(), 10, 1e-9);
  EXPECT_NEAR(limits.back(), 19, 1e-9);
}

// A loop that winds up asks for ten times what it gets.
TEST(TorqueSaturation, IsLookedForDownToUsualTorque) {
  const std::vector<double> limits = Limits(200);
  EXPECT_NEAR(limits.front(), 15, 1e-9);
  EXPECT_NEAR(limits.back(), 190, 1e-9);
  for (size_t k = 1; k < limits.size(); ++k) {
    EXPECT_LT(limits[k], 1.16 * limits[k - 1]);
  }
}

TEST(TorqueSaturation, OfNoTorqueHasSomeLimit) {
  for (const double limit : Limits(0, 0)) EXPECT_GT(limit, 0);
}

}  // namespace armcal::torque_saturation_test
