#include "calib/logs/torque_residual.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::torque_residual_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class Residual : public testing::Test {
 protected:
  Residual() : robot_(SampleRobot("2R planar (vertical plane)")) {
    SetRandomInertials(&random_, &robot_);
    log_ = RecordMotion(RandomMultisine(&random_, 2), 4, .01);
    AddTorque(robot_, &log_);
    exact_ = log_.tau;
  }
  TorqueResidual Evaluate(const Trajectory& t, double bandwidth = 0) const {
    const ModelParameters parameters(robot_, ModelParameters::Options());
    MotionRegressor regressor(parameters);
    regressor.Enter(t);
    TorqueResidual residual(2);
    residual.Add(t, parameters.Values(robot_), bandwidth, regressor);
    return residual;
  }

  std::mt19937_64 random_{6};
  Robot robot_;
  Log log_;
  MatrixXd exact_;
};

TEST_F(Residual, ExactTorqueLeavesNone) {
  for (const double bandwidth : {0., 5.}) {
    const auto f = Evaluate(MakeTrajectory(log_), bandwidth).whole();
    EXPECT_LT(f.percent.maxCoeff(), 1e-10);
    EXPECT_LT(f.stacked_percent, 1e-10);
  }
}

TEST_F(Residual, FiguresByHand) {
  log_.tau.col(0).array() += .3;
  log_.tau.col(1) *= 1.25;
  const TorqueResidual residual = Evaluate(MakeTrajectory(log_));
  const auto f = residual.whole();
  const VectorXd rms = ColumnRms(log_.tau), exact = ColumnRms(exact_);
  EXPECT_NEAR(f.torque_rms[0], rms[0], 1e-12);
  EXPECT_NEAR(f.residual_rms[0], .3, 1e-12);
  EXPECT_NEAR(f.percent[0], 100 * .3 / rms[0], 1e-10);
  EXPECT_NEAR(f.residual_rms[1], .25 * exact[1], 1e-12);
  EXPECT_NEAR(f.percent[1], 20, 1e-10);  // of the recorded torque
  EXPECT_NEAR(f.stacked_percent,
              100 * std::hypot(.3, .25 * exact[1]) / rms.norm(), 1e-10);
  EXPECT_EQ(residual.samples(), 401);
  EXPECT_EQ(residual.excluded_share(), 0);
}

TEST_F(Residual, StandstillIsLeftOutOfMovingOnly) {
  Trajectory t = MakeTrajectory(log_);
  t.standstill.head(100) = true;
  t.tau_recorded.topRows(100).col(0).array() += 5;
  t.tau_recorded.bottomRows(301).col(0).array() += 1;
  const TorqueResidual residual = Evaluate(t);
  EXPECT_NEAR(residual.moving().residual_rms[0], 1, 1e-12);
  EXPECT_NEAR(residual.whole().residual_rms[0],
              std::sqrt((100 * 25 + 301) / 401.), 1e-12);
  EXPECT_NEAR(residual.excluded_share(), 100 / 401., 1e-12);
}

// What stands for samples that a fit leaves out is its own prediction; the
// recorded ones count in all other figures.
TEST_F(Residual, SamplesLeftOutAreNotKept) {
  Trajectory t = MakeTrajectory(log_);
  t.tau.col(0).array() += .3;
  t.tau_recorded = t.tau;
  t.tau_recorded(200, 0) += 1000;
  t.tau(200, 0) -= .3;
  const TorqueResidual residual = Evaluate(t);
  EXPECT_NEAR(residual.kept().residual_rms[0], .3 * std::sqrt(400 / 401.),
              1e-12);
  EXPECT_NEAR(residual.kept().torque_rms[0], ColumnRms(t.tau)[0], 1e-12);
  EXPECT_NEAR(residual.moving().residual_rms[0],
              std::sqrt((400 * .09 + 1000.3 * 1000.3) / 401.), 1e-9);
}

TEST_F(Residual, CountsTheCoreOnly) {
  Trajectory t = MakeTrajectory(log_);
  t.core_begin = 50;
  t.core_end = 150;
  t.tau_recorded.topRows(50).array() += 100;
  t.tau_recorded.bottomRows(401 - 150).array() += 100;
  t.tau_recorded.middleRows(50, 100).array() += .2;
  const TorqueResidual residual = Evaluate(t);
  EXPECT_EQ(residual.samples(), 100);
  EXPECT_NEAR(residual.whole().residual_rms[1], .2, 1e-12);
}

TEST_F(Residual, TrajectoriesAddUp) {
  Trajectory t = MakeTrajectory(log_);
  t.tau_recorded.array() += .1;
  const ModelParameters parameters(robot_, ModelParameters::Options());
  MotionRegressor regressor(parameters);
  regressor.Enter(t);
  TorqueResidual residual(2);
  residual.Add(t, parameters.Values(robot_), 0, regressor);
  t.tau_recorded.array() += .2;
  residual.Add(t, parameters.Values(robot_), 0, regressor);
  EXPECT_EQ(residual.samples(), 802);
  EXPECT_NEAR(residual.whole().residual_rms[0], std::sqrt((.01 + .09) / 2),
              1e-12);
}

// A ripple well above the bandwidth does not count, one below does; gain of
// Butterworth 4 run twice: 1 / (1 + (f / fc)^8).
TEST_F(Residual, IsTakenWithinTheBandwidth) {
  for (const double hz : {1., 5., 20.}) {
    Log log = log_;
    for (int k = 0; k < log.size(); ++k) {
      log.tau(k, 0) += std::sin(2 * M_PI * hz * log.t[k]);
    }
    Trajectory t = MakeTrajectory(log);
    t.core_begin = 100;
    t.core_end = 300;
    const double gain = 1 / (1 + std::pow(hz / 5, 8));
    EXPECT_NEAR(Evaluate(t, 5).whole().residual_rms[0], gain / std::sqrt(2.),
                .01)
        << hz;
  }
}

TEST_F(Residual, NoTorqueHasNoPercentage) {
  log_.tau.col(1).setZero();
  const auto f = Evaluate(MakeTrajectory(log_)).whole();
  EXPECT_TRUE(std::isnan(f.percent[1]));
  EXPECT_NEAR(f.residual_rms[1], ColumnRms(exact_)[1], 1e-12);
  EXPECT_LT(f.percent[0], 1e-10);
}

TEST_F(Residual, NothingAdded) {
  const TorqueResidual residual(2);
  EXPECT_EQ(residual.samples(), 0);
  EXPECT_EQ(residual.excluded_share(), 0);
  EXPECT_TRUE(std::isnan(residual.moving().percent[0]));
}

}  // namespace armcal::torque_residual_test
