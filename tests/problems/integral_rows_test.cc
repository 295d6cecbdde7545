#include "problems/integral_rows.h"

#include <gtest/gtest.h>

#include <cmath>

#include "problems/make_rows.h"
#include "tests/fixtures/two_link_arm.h"
#include "tests/problems/row_tiles.h"

namespace armcal::integral_rows_test {

using Eigen::VectorXd;

constexpr double kPi = 3.14159265358979323846;

RowOptions Integral(Quadrature quadrature = Quadrature::kTrapezoid) {
  RowOptions options;
  options.identification = Identification::kIntegral;
  options.quadrature = quadrature;
  return options;
}

ModelParameters Parameters(const Robot& robot,
                           std::vector<JointTerm> terms = {}) {
  ModelParameters::Options options;
  options.joint_terms = terms;
  options.transitions.assign(robot.links.size(), {CoulombTransition()});
  return ModelParameters(robot, options);
}

// A lift of mass m: int f dt = m (v2 - v1 + g (t2 - t1)), here along
// q = t^3 / 6 - sin t, f of which is chosen as 7 cos 2 t.
TEST(IntegralRows, LiftInClosedForm) {
  Robot robot;
  robot.gravity = {0, 0, -9.81};
  robot.links.resize(1);
  robot.links[0].joint.type = JointType::kPrismatic;
  const ModelParameters parameters = Parameters(robot);
  ASSERT_EQ(parameters.size(), 1);
  Trajectory t;
  const int n = 401;
  t.dt = .01;
  for (auto* x : {&t.q, &t.qd, &t.qdd, &t.tau}) x->resize(n, 1);
  for (int k = 0; k < n; ++k) {
    const double s = t.time(k);
    t.q(k) = s * s * s / 6 - std::sin(s);
    t.qd(k) = s * s / 2 - std::cos(s);
    t.qdd(k) = s + std::sin(s);
    t.tau(k) = 7 * std::cos(2 * s);
  }
  t.standstill.setConstant(n, false);
  t.core_end = n;
  RowOptions options = Integral(Quadrature::kSimpson);
  options.intervals = {{0, 1}, {.5, 3.1}, {2, 3.99}, {1, 1.01}};
  MotionRegressor regressor(parameters);
  const auto rows = Rows(t, options, &regressor);
  ASSERT_EQ(rows.size(), 4);
  for (size_t r = 0; r < 4; ++r) {
    const double a = options.intervals[r].begin, b = options.intervals[r].end;
    const double dv = (b * b - a * a) / 2 - std::cos(b) + std::cos(a);
    EXPECT_NEAR(rows[r].U(0, 0), dv + 9.81 * (b - a), 1e-11) << r;
    EXPECT_NEAR(rows[r].Y[0], 3.5 * (std::sin(2 * b) - std::sin(2 * a)), 1e-6)
        << r;
    EXPECT_NEAR(rows[r].time, (a + b) / 2, .0051);
  }
}

// Errors of both sides against the textbook's arm fall with dt^2 and dt^4.
TEST(IntegralRows, OrderOfTheRules) {
  const TwoLinkArm arm;
  const ModelParameters parameters = Parameters(arm.ToRobot());
  const VectorXd X = parameters.Values(arm.ToRobot());
  const auto error = [&](Quadrature rule, double dt, double end) {
    RowOptions options = Integral(rule);
    options.intervals = {{.3, end}};
    MotionRegressor regressor(parameters);
    const auto rows =
        Rows(arm.Record(dt, static_cast<int>(std::lround(4 / dt))), options,
             &regressor);
    EXPECT_EQ(rows.size(), 1);
    return (rows.at(0).U * X - rows.at(0).Y).norm();
  };
  const auto order = [&](Quadrature rule, double end) {
    return std::log2(error(rule, .02, end) / error(rule, .01, end));
  };
  EXPECT_NEAR(order(Quadrature::kTrapezoid, 2.3), 2, .1);
  EXPECT_NEAR(order(Quadrature::kSimpson, 2.3), 4, .2);
  EXPECT_LT(error(Quadrature::kSimpson, .002, 2.3), 1e-8);
  // Also over an odd number of steps.
  EXPECT_LT(error(Quadrature::kSimpson, .02, 2.32), 1e-4);
  EXPECT_LT(error(Quadrature::kSimpson, .002, 2.302), 2e-8);
}

TEST(IntegralRows, IntervalsSideBySide) {
  const TwoLinkArm arm;
  MotionRegressor regressor(Parameters(arm.ToRobot()));
  RowOptions options = Integral();
  options.interval_s = .5;
  const auto rows = Rows(arm.Record(.01, 401), options, &regressor);
  ASSERT_EQ(rows.size(), 8);
  for (int r = 0; r < 8; ++r) EXPECT_NEAR(rows[r].time, .25 + .5 * r, 1e-9);
}

TEST(IntegralRows, TileAcrossCores) {
  for (const bool given : {false, true}) {
    RowOptions options = Integral(Quadrature::kSimpson);
    options.interval_s = .33;
    if (given) options.intervals = {{0, 1.2}, {2.99, 3.5}, {3, 4.2}, {9, 9.99}};
    EXPECT_EQ(ExpectRowsTile(Parameters(TwoLinkArm().ToRobot()), options, .01,
                             130, {0, 300, 301, 680, 777, 1000}, 1e-10),
              given ? 4 : 29);  // 34 steps, as at 680
  }
}

// An interval that a gap cuts, or that lies outside, is left out.
TEST(IntegralRows, LeaveOutWhatIsNotThere) {
  const TwoLinkArm arm;
  MotionRegressor regressor(Parameters(arm.ToRobot()));
  RowOptions options = Integral();
  options.intervals = {{-1, 1}, {3, 5}, {8, 9}, {1, 1}, {2, 1}, {1, 3.99}};
  const auto rows = Rows(arm.Record(.01, 400), options, &regressor);
  ASSERT_EQ(rows.size(), 1);
  EXPECT_NEAR(rows[0].time, 2.495, .006);
}

TEST(IntegralRows, LeaveOutStandstillOnlyWithCoulombFriction) {
  const TwoLinkArm arm;
  Trajectory t = arm.Record(.01, 401);
  t.standstill.segment(150, 60) = true;  // 3 intervals of 0.5 s
  for (const bool friction : {false, true}) {
    std::vector<JointTerm> terms = {JointTerm::kOffset};
    if (friction) terms.push_back(JointTerm::kCoulomb);
    MotionRegressor regressor(Parameters(arm.ToRobot(), terms));
    EXPECT_EQ(Rows(t, Integral(), &regressor).size(), friction ? 5 : 8);
  }
}

TEST(RowReach, CoversTheRows) {
  RowOptions options = Integral();
  EXPECT_EQ(RowReach(options), .5);
  options.intervals = {{1, 2}, {4, 7}};
  EXPECT_EQ(RowReach(options), 3);
  options.identification = Identification::kWeak;
  options.window_s = .8;
  EXPECT_EQ(RowReach(options), .8);
  options.identification = Identification::kDifferential;
  EXPECT_EQ(RowReach(options), 0);
  options.bandwidth_hz = 5;  // ln 1e9 / (sin(pi / 8) 2 pi 5 Hz)
  EXPECT_NEAR(RowReach(options), 20.7 / (std::sin(kPi / 8) * 10 * kPi), 1e-12);
}

}  // namespace armcal::integral_rows_test
