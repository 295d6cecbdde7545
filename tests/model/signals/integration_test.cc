#include "model/signals/integration.h"

#include <gmock/gmock.h>

#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>
#include <limits>

#include "model/dynamics/forward_dynamics.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::integration_test {

using Eigen::VectorXd;
using testing::HasSubstr;

VectorXd V(std::initializer_list<double> values) {
  VectorXd v(values.size());
  std::copy(values.begin(), values.end(), v.begin());
  return v;
}

std::vector<double> Times(double end, int count) {
  std::vector<double> times;
  for (int k = 0; k <= count; ++k) times.push_back(end * k / count);
  return times;
}

// Released at rest at A: sin(q / 2) = k sn(K(k) - w t, k), k = sin(A / 2).
TEST(Integrate, PendulumOfLargeAmplitude) {
  const double w2 = 9.81 / .7, amplitude = 2.5, k = std::sin(amplitude / 2);
  const auto times = Times(10, 50);
  IntegrationOptions options;
  options.relative = options.absolute = 1e-12;
  const Integration swing =
      Integrate([w2](double, const VectorXd& x,
                     VectorXd* rate) { *rate << x[1], -w2 * std::sin(x[0]); },
                V({amplitude, 0}), 0, times, options);
  ASSERT_TRUE(swing.finished) << swing.reason;
  for (size_t i = 0; i < times.size(); ++i) {
    const double sn = boost::math::jacobi_sn(
        k, std::comp_ellint_1(k) - std::sqrt(w2) * times[i]);
    EXPECT_NEAR(swing.x(i, 0), 2 * std::asin(k * sn), 1e-8) << times[i];
  }
}

// The tolerance steers the error, and with it the number of steps.
TEST(Integrate, ErrorFollowsTheTolerance) {
  const auto error = [](double tolerance, long* steps) {
    IntegrationOptions options;
    options.relative = options.absolute = tolerance;
    const Integration run = Integrate(
        [](double, const VectorXd& x, VectorXd* rate) { *rate << x[1], -x[0]; },
        V({1, 0}), 0, {20}, options);
    *steps = run.steps;
    return std::abs(run.x(0, 0) - std::cos(20));
  };
  long coarse = 0, fine = 0;
  EXPECT_LT(error(1e-5, &coarse), 1e-3);
  EXPECT_LT(error(1e-11, &fine), 1e-9);
  EXPECT_GT(fine, 5 * coarse);
}

// A recorded signal, linear between samples: exact where the kinks are output
// times, and no step has to be shortened for them.
TEST(Integrate, RateMayBendAtOutputTimes) {
  const auto hat = [](double t) { return std::abs(t - std::round(t)); };
  const Integration run = Integrate(
      [&hat](double t, const VectorXd&, VectorXd* rate) { *rate << hat(t); },
      V({0}), 0, Times(4, 8));
  ASSERT_TRUE(run.finished);
  for (int k = 0; k <= 8; ++k) EXPECT_NEAR(run.x(k, 0), k / 8.0, 1e-13);
  EXPECT_LT(run.steps, 30);
}

// Torque-free, frictionless: 10 s of arms that swing as gravity lets them.
TEST(Integrate, PassiveSwingKeepsItsEnergy) {
  std::mt19937_64 random(7);
  for (int run = 0; run < 12; ++run) {
    const int n = 1 + run % 6;
    Robot robot = RandomArm(n, &random);
    SetRandomInertials(&random, &robot);
    VectorXd x0(2 * n);
    x0 << UniformVector(&random, n, -2, 2), UniformVector(&random, n, -1, 1);
    IntegrationOptions options;
    options.relative = options.absolute = 1e-11;
    const Integration swing = Integrate(
        [&robot, n](double, const VectorXd& x, VectorXd* rate) {
          *rate << x.tail(n),
              ForwardDynamics(robot, x.head(n), x.tail(n), VectorXd::Zero(n));
        },
        x0, 0, Times(10, 40), options);
    ASSERT_TRUE(swing.finished) << run << ": " << swing.reason;
    const double start = Energy(robot, x0.head(n), x0.tail(n)).total();
    double kinetic = 0, drift = 0;
    for (const auto& row : swing.x.rowwise()) {
      const VectorXd x = row.transpose();
      const ArmEnergy energy = Energy(robot, x.head(n), x.tail(n));
      kinetic = std::max(kinetic, energy.kinetic);
      drift = std::max(drift, std::abs(energy.total() - start));
    }
    EXPECT_LT(drift, 1e-6 * kinetic) << run;
  }
}

// x' = x^2 from 1 is 1 / (1 - t): infinite at t = 1.
TEST(Integrate, StopsAtASingularity) {
  const Integration run = Integrate(
      [](double, const VectorXd& x, VectorXd* rate) { *rate << x[0] * x[0]; },
      V({1}), 0, {.5, .9, 2});
  EXPECT_FALSE(run.finished);
  ASSERT_EQ(run.x.rows(), 2);
  EXPECT_NEAR(run.x(1, 0), 10, 1e-5);
  EXPECT_FALSE(run.reason.empty());
}

TEST(Integrate, StopsWhereTheRateIsNoNumber) {
  const Integration run = Integrate(
      [](double t, const VectorXd&, VectorXd* rate) {
        *rate << (t < .25 ? 1 : std::numeric_limits<double>::quiet_NaN());
      },
      V({0}), 0, {.2, 1});
  EXPECT_FALSE(run.finished);
  EXPECT_EQ(run.x.rows(), 1);
  EXPECT_THAT(run.reason, HasSubstr("finite after t = 0.2"));
}

TEST(Integrate, StopsAfterTooManySteps) {
  IntegrationOptions options;
  options.max_steps = 100;
  const Integration run =
      Integrate([](double t, const VectorXd&,
                   VectorXd* rate) { *rate << std::cos(1e5 * t); },
                V({0}), 0, {10}, options);
  EXPECT_FALSE(run.finished);
  EXPECT_THAT(run.reason, HasSubstr("more than 100 steps"));
}

}  // namespace armcal::integration_test
