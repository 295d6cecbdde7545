#include "calib/inspect/torque_scale.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calib/logs/uniform_series.h"
#include "tests/fixtures/inspected_arm.h"

namespace armcal::torque_scale_test {

TEST(TorqueScale, IsThatOfTheTorque) {
  InspectedArm arm;
  for (const double factor : {1., .1, -20.}) {
    Log log = arm.log;
    log.tau *= factor;
    const Eigen::VectorXd scale =
        TorqueScale(arm.robot, UniformSeries(log, .01, .05, 8).Pick(300, 0));
    int told = 0;
    for (const double x : scale) {
      if (std::isnan(x)) continue;
      ++told;
      EXPECT_NEAR(x, factor, .1 * std::abs(factor));
    }
    EXPECT_GE(told, 4);
  }
}

// Torques that are another motion's tell nothing.
TEST(TorqueScale, IsNothingWhereTorquesAreNotAlike) {
  InspectedArm arm;
  Log log = arm.log;
  std::mt19937_64 random(3);
  log.tau.setZero();
  AddNoise(&random, Eigen::VectorXd::Ones(6), &log.tau);
  const Eigen::VectorXd scale =
      TorqueScale(arm.robot, UniformSeries(log, .01, .05, 8).Pick(300, 0));
  EXPECT_TRUE(scale.array().isNaN().all());
}

}  // namespace armcal::torque_scale_test
