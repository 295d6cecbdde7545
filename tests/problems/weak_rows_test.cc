#include "problems/weak_rows.h"

#include <gtest/gtest.h>

#include <cmath>

#include "problems/make_rows.h"
#include "tests/fixtures/two_link_arm.h"
#include "tests/problems/row_tiles.h"

namespace armcal::weak_rows_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

ModelParameters Parameters(const TwoLinkArm& arm,
                           std::vector<JointTerm> terms = {}) {
  ModelParameters::Options options;
  options.joint_terms = terms;
  options.transitions.assign(2, {CoulombTransition()});
  return ModelParameters(arm.ToRobot(), options);
}

double LargestError(const std::vector<IdentificationRow>& rows,
                    const VectorXd& X) {
  double error = 0;
  for (const IdentificationRow& row : rows) {
    error = std::max(error, (row.U * X - row.Y).cwiseAbs().maxCoeff());
  }
  return error;
}

// Exact data of the textbook's arm, torques of 10 to 40 N m. The trapezoid rule
// has order 4, since the fourth derivative of phi jumps at its ends.
TEST(WeakRows, ExactDataMeetTheEquations) {
  TwoLinkArm arm;
  arm.viscous = 1.3;
  const ModelParameters parameters = Parameters(arm, {JointTerm::kViscous});
  const VectorXd X = parameters.Values(arm.ToRobot());
  const auto error = [&](double dt) {
    MotionRegressor regressor(parameters);
    const int n = static_cast<int>(std::lround(4 / dt));
    const auto rows = Rows(arm.Record(dt, n), RowOptions(), &regressor);
    EXPECT_GT(rows.size(), 25);
    return LargestError(rows, X);
  };
  EXPECT_LT(error(.001), 1e-8);
  EXPECT_LT(error(.01), 1e-4);
  EXPECT_NEAR(std::log2(error(.01) / error(.005)), 4, .1);
}

// A parameter that is 1 % wrong is seen.
TEST(WeakRows, DependOnEveryParameter) {
  const TwoLinkArm arm;
  const ModelParameters parameters = Parameters(arm);
  const VectorXd X = parameters.Values(arm.ToRobot());
  MotionRegressor regressor(parameters);
  const auto rows = Rows(arm.Record(.005, 800), RowOptions(), &regressor);
  for (int k = 0; k < X.size(); ++k) {
    VectorXd wrong = X;
    wrong[k] += .01;
    EXPECT_GT(LargestError(rows, wrong), 1e-3)
        << parameters.parameters()[k].name;
  }
}

// Y is the mean torque under (1 - s^2)^4: of a constant the constant, of t its
// time, of t^2 T^2 + (L/2)^2 / 11 (the mean of s^2 is 1/11).
TEST(WeakRows, AreMeanTorques) {
  const TwoLinkArm arm;
  Trajectory t = arm.Record(.002, 1500);
  for (int k = 0; k < t.size(); ++k) {
    t.tau.row(k) << 3, t.time(k) * t.time(k);
  }
  MotionRegressor regressor(Parameters(arm));
  RowOptions options;
  options.window_s = .4;
  for (const auto& row : Rows(t, options, &regressor)) {
    EXPECT_NEAR(row.Y[0], 3, 1e-12);
    EXPECT_NEAR(row.Y[1], row.time * row.time + .04 / 11, 1e-8);
  }
}

TEST(WeakRows, WindowsStartAtMultiplesOfTheHop) {
  const TwoLinkArm arm;
  const Trajectory t = arm.Record(.01, 401);  // 4 s
  RowOptions options;
  options.window_s = .8;
  for (const int hops : {1, 4, 8}) {
    options.hops = hops;
    MotionRegressor regressor(Parameters(arm));
    const auto rows = Rows(t, options, &regressor);
    ASSERT_EQ(rows.size(), (4 - .8) / (.8 / hops) + 1);
    for (size_t k = 0; k < rows.size(); ++k) {
      EXPECT_NEAR(rows[k].time, .4 + .8 / hops * k, 1e-9);
    }
  }
}

// Cut anywhere, the windows are those of the whole, each once.
TEST(WeakRows, TileAcrossCores) {
  const double dt = .01;
  const int margin = 60;
  for (const double window : {.5, .17}) {
    SCOPED_TRACE(window);
    RowOptions options;
    options.window_s = window;
    ASSERT_LE(RowReach(options), margin * dt);
    ExpectRowsTile(Parameters(TwoLinkArm()), options, dt, margin,
                   {0, 137, 138, 300, 512, 701, 1100, 1200}, 1e-10);
  }
}

TEST(WeakRows, LeaveOutStandstillOnlyWithCoulombFriction) {
  const TwoLinkArm arm;
  Trajectory t = arm.Record(.01, 401);
  t.standstill.segment(150, 60) = true;  // 1.50 to 2.09 s
  for (const bool friction : {false, true}) {
    std::vector<JointTerm> terms = {JointTerm::kViscous};
    if (friction) terms.push_back(JointTerm::kCoulomb);
    MotionRegressor regressor(Parameters(arm, terms));
    int inside = 0;
    for (const auto& row : Rows(t, RowOptions(), &regressor)) {
      // Windows of 0.5 s around these times reach into it.
      inside += row.time > 1.251 && row.time < 2.339;
    }
    EXPECT_EQ(inside > 0, !friction);
  }
}

TEST(WeakRows, ShortStretchesHaveNone) {
  const TwoLinkArm arm;
  MotionRegressor regressor(Parameters(arm));
  EXPECT_TRUE(Rows(arm.Record(.01, 50), RowOptions(), &regressor).empty());
  EXPECT_EQ(Rows(arm.Record(.01, 51), RowOptions(), &regressor).size(), 1);
  EXPECT_TRUE(Rows(arm.Record(.01, 3), RowOptions(), &regressor).empty());
}

}  // namespace armcal::weak_rows_test
