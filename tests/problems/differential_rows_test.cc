#include "problems/differential_rows.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/signals/low_pass.h"
#include "problems/make_rows.h"
#include "tests/fixtures/two_link_arm.h"
#include "tests/problems/row_tiles.h"

namespace armcal::differential_rows_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

ModelParameters Parameters(std::vector<JointTerm> terms = {}) {
  ModelParameters::Options options;
  options.joint_terms = terms;
  options.transitions.assign(2, {CoulombTransition()});
  return ModelParameters(TwoLinkArm().ToRobot(), options);
}

RowOptions Differential(double bandwidth = 0) {
  RowOptions options;
  options.identification = Identification::kDifferential;
  options.bandwidth_hz = bandwidth;
  return options;
}

TEST(DifferentialRows, AreTheRegressorAtEverySample) {
  const TwoLinkArm arm;
  const ModelParameters parameters = Parameters();
  const Trajectory t = arm.Record(.01, 100);
  MotionRegressor motion(parameters);
  const auto rows = Rows(t, Differential(), &motion);
  ASSERT_EQ(rows.size(), 100);
  Regressor regressor = parameters.MakeRegressor();
  const VectorXd X = parameters.Values(arm.ToRobot());
  MatrixXd U;
  for (int k = 0; k < 100; ++k) {
    regressor.Differential(t.q.row(k), t.qd.row(k), t.qdd.row(k), VectorXd(),
                           &U);
    EXPECT_LT((rows[k].U - U).norm(), 1e-14 * U.norm());
    EXPECT_EQ(rows[k].Y, t.tau.row(k).transpose());
    EXPECT_NEAR(rows[k].time, .01 * k, 1e-12);
    EXPECT_LT((rows[k].U * X - rows[k].Y).norm(), 1e-11);  // the textbook's
  }
}

// Both sides pass the same filter, so exact data stay exact.
TEST(DifferentialRows, FilterBothSidesAlike) {
  const TwoLinkArm arm;
  const ModelParameters parameters = Parameters();
  const Trajectory t = arm.Record(.005, 800);
  MotionRegressor regressor(parameters);
  const auto rows = Rows(t, Differential(3), &regressor);
  // 4 per period of 3 Hz: every 16th sample, but for the filter's ends.
  ASSERT_GE(rows.size(), 37);
  const VectorXd X = parameters.Values(arm.ToRobot());
  const MatrixXd tau = ZeroPhaseLowPass(t.tau, 200, 3);
  for (size_t r = 0; r < rows.size(); ++r) {
    const long k = std::lround(rows[r].time / t.dt);
    EXPECT_EQ(k % 16, 0);
    EXPECT_NEAR(rows[r].time, rows[0].time + .08 * r, 1e-9);
    EXPECT_LT((rows[r].Y - tau.row(k).transpose()).norm(), 1e-12);
    EXPECT_LT((rows[r].U * X - rows[r].Y).norm(), 1e-10);
  }
  EXPECT_GT((tau - t.tau).cwiseAbs().maxCoeff(), .1);  // it does filter
}

TEST(DifferentialRows, TileAcrossCores) {
  const double dt = .01;
  for (const double bandwidth : {0.0, 5.0}) {
    SCOPED_TRACE(bandwidth);
    const RowOptions options = Differential(bandwidth);
    // As TrajectoryReader makes them: twice the filter's memory at least.
    const int margin =
        10 + static_cast<int>(std::ceil(2 * RowReach(options) / dt));
    ExpectRowsTile(Parameters(), options, dt, margin,
                   {0, 600, 607, 1500, 2201, 3000}, 1e-8);
  }
}

TEST(DifferentialRows, LeaveOutStandstillOnlyWithCoulombFriction) {
  Trajectory t = TwoLinkArm().Record(.01, 200);
  t.standstill.segment(50, 70) = true;
  MotionRegressor without(Parameters({JointTerm::kViscous}));
  EXPECT_EQ(Rows(t, Differential(), &without).size(), 200);
  MotionRegressor with(Parameters({JointTerm::kCoulomb}));
  const auto rows = Rows(t, Differential(), &with);
  ASSERT_EQ(rows.size(), 130);
  EXPECT_NEAR(rows[49].time, .49, 1e-9);
  EXPECT_NEAR(rows[50].time, 1.2, 1e-9);
}

// Columns of joint terms stand in their own joint's row only.
TEST(DifferentialRows, HoldJointTerms) {
  const ModelParameters parameters =
      Parameters({JointTerm::kViscous, JointTerm::kCoulomb});
  const Trajectory t = TwoLinkArm().Record(.01, 50);
  MotionRegressor regressor(parameters);
  for (const auto& row : Rows(t, Differential(), &regressor)) {
    const int k = static_cast<int>(std::lround(row.time / t.dt));
    for (int c = 0; c < parameters.size(); ++c) {
      const ModelParameter& p = parameters.parameters()[c];
      if (!p.is_joint_term) continue;
      const double qd = t.qd(k, p.block);
      EXPECT_EQ(row.U(1 - p.block, c), 0);
      EXPECT_NEAR(row.U(p.block, c),
                  p.term == JointTerm::kViscous ? qd : std::tanh(qd / .02),
                  1e-14);
    }
  }
}

}  // namespace armcal::differential_rows_test
