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
    const TorqueScales scales =
        TorqueScale(arm.robot, UniformSeries(log, .01, .05, 8).Pick(300, 0));
    int told = 0;
    for (int j = 0; j < arm.robot.num_joints(); ++j) {
      if (!scales.told(j)) continue;
      ++told;
      EXPECT_NEAR(scales.scale[j], factor, .1 * std::abs(factor));
      EXPECT_LT(scales.low[j], scales.scale[j]);
      EXPECT_GT(scales.high[j], scales.scale[j]);
      // The same torques, read in their own unit, are the file's.
      EXPECT_LT(scales.Left(j, factor), .3);
    }
    EXPECT_GE(told, 4);
    EXPECT_EQ(scales.AreOpposite(), factor < 0);
    EXPECT_NEAR(scales.Size(), std::abs(factor), .1 * std::abs(factor));
  }
}

// One that is along with what the links need, and one that tells nothing.
TEST(TorqueScale, AreNotOppositeWhereOneIsNot) {
  TorqueScales scales;
  scales.scale = scales.low = scales.high = Eigen::Vector3d(-1, -2, NAN);
  EXPECT_TRUE(scales.AreOpposite());
  scales.high[1] = .1;
  EXPECT_FALSE(scales.AreOpposite());
  scales.scale[1] = NAN;  // a load may be opposite to a single joint's links
  EXPECT_FALSE(scales.AreOpposite());
}

// Torques that are another motion's tell nothing.
TEST(TorqueScale, IsNothingWhereTorquesAreNotAlike) {
  InspectedArm arm;
  Log log = arm.log;
  std::mt19937_64 random(3);
  log.tau.setZero();
  AddNoise(&random, Eigen::VectorXd::Ones(6), &log.tau);
  const TorqueScales scales =
      TorqueScale(arm.robot, UniformSeries(log, .01, .05, 8).Pick(300, 0));
  EXPECT_TRUE(scales.scale.array().isNaN().all());
}

// One in fifty samples is a gross error of three times the torque's rms.
TEST(TorqueScale, StandsGrossErrors) {
  InspectedArm arm;
  WiringSamples samples = UniformSeries(arm.log, .01, .05, 8).Pick(400, 0);
  const Eigen::VectorXd size = ColumnRms(samples.tau);
  for (int s = 7; s < samples.tau.rows(); s += 50) {
    samples.tau.row(s) += 3 * size.transpose();
  }
  const TorqueScales scales = TorqueScale(arm.robot, samples);
  int told = 0;
  for (int j = 0; j < arm.robot.num_joints(); ++j) {
    if (!scales.told(j)) continue;
    ++told;
    EXPECT_NEAR(scales.scale[j], 1, .1);
  }
  EXPECT_GE(told, 4);
}

}  // namespace armcal::torque_scale_test
