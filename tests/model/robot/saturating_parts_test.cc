#include "model/robot/saturating_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace armcal::saturating_parts_test {

using Eigen::ArrayXd;

double Force(const std::vector<SaturatingPart>& parts, double x) {
  double sum = 0;
  for (const SaturatingPart& part : parts) {
    sum += part.force * std::clamp(x / part.width, -1., 1.);
  }
  return sum;
}

// By hand: slopes 2, .5, -1 and 0 between the knots 1, 3 and 4.
TEST(SaturatingParts, AreTheBendsOfTheLine) {
  const auto parts = PartsOf({{0, 0}, {1, 2}, {3, 3}, {4, 2}});
  ASSERT_EQ(parts.size(), 3);
  EXPECT_DOUBLE_EQ(parts[0].force, 1.5);
  EXPECT_DOUBLE_EQ(parts[1].force, 4.5);
  EXPECT_DOUBLE_EQ(parts[2].force, -4);
  EXPECT_DOUBLE_EQ(parts[2].width, 4);
  for (const auto& [x, force] : {std::pair(.5, 1.), {2., 2.5}, {9., 2.}}) {
    EXPECT_DOUBLE_EQ(Force(parts, x), force);
    EXPECT_DOUBLE_EQ(Force(parts, -x), -force);
  }
}

// A curve that is a line already has no more knots than that has.
TEST(SaturatingParts, KnotsAreThoseOfALine) {
  const ArrayXd x = ArrayXd::LinSpaced(40, .1, 4);
  const ArrayXd f =
      x.unaryExpr([](double at) { return at < 2 ? at : std::max(1., 4 - at); });
  const std::vector<Knot> knots = FitKnots(x, f, 1e-6);
  ASSERT_EQ(knots.size(), 4);
  EXPECT_NEAR(knots[1].x, 2, 1e-12);
  EXPECT_NEAR(knots[2].x, 3, 1e-12);
  EXPECT_NEAR(knots[2].force, 1, 1e-12);
}

// Values of least squares: the line is on both sides of a curve that bends one
// way only, and what is between them has no mean.
TEST(SaturatingParts, TheLineIsNotBiased) {
  const ArrayXd x = ArrayXd::LinSpaced(300, .01, 3);
  const std::vector<SaturatingPart> parts = PartsOf(FitKnots(x, x.tanh(), .02));
  ArrayXd off(x.size());
  for (int i = 0; i < x.size(); ++i) {
    off[i] = Force(parts, x[i]) - std::tanh(x[i]);
  }
  EXPECT_LT(off.abs().maxCoeff(), .02);
  EXPECT_LT(std::abs(off.mean()), .002);
  EXPECT_GT(off.maxCoeff(), .002);
  EXPECT_LT(parts.size(), 9);
}

TEST(SaturatingParts, TheHullBendsDownOnly) {
  const auto hull = ConcaveHull({{0, 0}, {1, .2}, {2, 2}, {3, 2}});
  ASSERT_EQ(hull.size(), 3);
  EXPECT_EQ(hull[1].x, 2);
  for (const SaturatingPart& part : PartsOf(hull)) EXPECT_GT(part.force, 0);
}

TEST(SaturatingParts, ABoundedSpringIsNearlyTanh) {
  const BoundedSpring spring = TanhSpring(3, .4, .25);
  EXPECT_EQ(spring.centre, .4);
  for (double x = -4; x < 4; x += .01) {
    EXPECT_NEAR(Force(spring.parts, x), 3 * std::tanh(x / .25), .01 * 3) << x;
  }
  EXPECT_NEAR(Force(spring.parts, 9), 3, 1e-3);
  EXPECT_LT(spring.parts.size(), 11);
}

}  // namespace armcal::saturating_parts_test
