#include "problems/trajectory_spline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace armcal::trajectory_spline_test {

using Eigen::MatrixXd;

MatrixXd Sampled(int samples, double dt,
                 const std::function<double(double)>& f) {
  MatrixXd x(samples, 1);
  for (int k = 0; k < samples; ++k) x(k, 0) = f(k * dt);
  return x;
}

// Quintic polynomials are quintic splines.
TEST(TrajectorySpline, KeepsAQuinticAndItsDerivatives) {
  const int samples = 200;
  const double dt = .004;
  const TrajectorySpline spline(samples, dt, .06);
  const MatrixXd points = spline.Fit(Sampled(samples, dt, [](double t) {
    return 1 - 2 * t + 3 * t * t * t - 5 * std::pow(t, 5);
  }));
  const auto expect = [&](int order, const std::function<double(double)>& f) {
    const MatrixXd error =
        spline.Evaluate(points, order) - Sampled(samples, dt, f);
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-8) << order;
  };
  expect(0, [](double t) {
    return 1 - 2 * t + 3 * t * t * t - 5 * std::pow(t, 5);
  });
  expect(1, [](double t) { return -2 + 9 * t * t - 25 * std::pow(t, 4); });
  expect(2, [](double t) { return 18 * t - 100 * t * t * t; });
}

TEST(TrajectorySpline, WeightsOfPositionAddUpToOneAndOthersToZero) {
  const TrajectorySpline spline(101, .01, .07);
  for (int k = 0; k < spline.size(); ++k) {
    const auto sums = spline.basis(k).weights.rowwise().sum().eval();
    EXPECT_NEAR(sums[0], 1, 1e-14);
    EXPECT_NEAR(sums[1], 0, 1e-11);
    EXPECT_NEAR(sums[2], 0, 1e-9);
    EXPECT_GE(spline.basis(k).weights.row(0).minCoeff(), 0);
  }
}

TEST(TrajectorySpline, KnotsDivideTheStretchAndKeepSamplesBetweenThem) {
  const TrajectorySpline spline(101, .01, .07);  // 1 s: 14 intervals
  EXPECT_EQ(spline.num_points(), 14 + 5);
  EXPECT_NEAR(spline.knot_s(), 1. / 14, 1e-15);
  EXPECT_EQ(spline.basis(100).first, 13);
  const TrajectorySpline coarse(101, .01, .001);  // knots closer than samples
  EXPECT_NEAR(coarse.knot_s(), .03, 1e-3);
}

// The error of the best quintic spline falls with the sixth power of knots.
TEST(TrajectorySpline, ConvergesWithOrderSix) {
  double last = 0;
  for (const double knot : {.05, .025}) {
    const TrajectorySpline spline(2001, .001, knot);
    const MatrixXd sine =
        Sampled(2001, .001, [](double t) { return std::sin(12 * t); });
    const MatrixXd error = spline.Evaluate(spline.Fit(sine), 0) - sine;
    const double rms = error.norm() / std::sqrt(2001.);
    if (last > 0) {
      EXPECT_NEAR(std::log2(last / rms), 6, .4);
    }
    last = rms;
  }
}

}  // namespace armcal::trajectory_spline_test
