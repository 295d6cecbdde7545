#include "calib/diagnose/candidates/coordinates.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures/effect_arm.h"

namespace armcal::coordinates_test {

using Eigen::VectorXd;

class GapCoordinatesTest : public testing::Test {
 protected:
  GapCoordinatesTest()
      : arm_("2R planar (vertical plane)", 20, .005),
        baseline_(arm_.robot, {}, VectorXd::Constant(2, 10)) {}

  std::vector<Coordinate> Of(const char* name) const {
    return ListCoordinates(baseline_, arm_.scale, {OfOnes(name)}, 0);
  }
  static GapCandidate OfOnes(const char* name) {
    GapCandidate effect;
    effect.effect = FindEffect(name);
    effect.joint = 1;
    effect.p = VectorXd::Ones(effect.effect->parameters.size());
    effect.size = VectorXd::Ones(effect.effect->parameters.size());
    return effect;
  }

  EffectArm arm_;
  GapBaseline baseline_;
};

// A neighbour's number is chosen, not fitted.
TEST_F(GapCoordinatesTest, WhatIsVaried) {
  EXPECT_EQ(Of("viscous_friction").size(), 1u);
  EXPECT_EQ(Of("cable").size(), 3u);
  EXPECT_EQ(Of("coupled_friction").size(), 4u);
}

// Friction that grows until a robot is fast is viscous, not dry: on a fast
// joint the width of a coupling ends where that of calibrate's Coulomb friction
// does, .3 rad/s (docs/calibrate.md).
TEST_F(GapCoordinatesTest, NoDryFrictionIsWide) {
  const auto widest = [&](double speed) {
    arm_.scale.speed.setConstant(speed);
    GapCandidate effect = OfOnes("coupled_friction");
    effect.joint = 0;
    effect.p[4] = .1;
    return ListCoordinates(baseline_, arm_.scale, {effect}, 0).back().high;
  };
  EXPECT_DOUBLE_EQ(widest(5), .3);
  EXPECT_DOUBLE_EQ(widest(.4), .2);
}

// Where stamps are even, unevenness says nothing.
TEST_F(GapCoordinatesTest, WhatHasNoTorqueIsNotVaried) {
  GapCandidate clock = OfOnes("time_base");
  const auto list = [&] {
    return ListCoordinates(baseline_, arm_.scale, {clock}, 0);
  };
  EXPECT_EQ(list().size(), 2u) << "not evaluated yet";
  clock.torque = {{VectorXd::Ones(3), VectorXd()}, JointRows(2)};
  ASSERT_EQ(list().size(), 1u);
  EXPECT_EQ(list()[0].parameter, 0);
}

TEST_F(GapCoordinatesTest, OfOneEffectOrOfAll) {
  const std::vector<GapCandidate> effects = {OfOnes("cable"),
                                             OfOnes("viscous_friction")};
  EXPECT_EQ(ListCoordinates(baseline_, arm_.scale, effects, -1).size(), 4u);
  const auto second = ListCoordinates(baseline_, arm_.scale, effects, 1);
  ASSERT_EQ(second.size(), 1u);
  EXPECT_EQ(second[0].effect, 1);
  EXPECT_EQ(second[0].parameter, 0);
}

// Of one that was taken off, too.
TEST_F(GapCoordinatesTest, ABodysInertiaHasTheSignOfItsMass) {
  for (const double sign : {1., -1.}) {
    GapCandidate body = OfOnes("added_mass");
    body.p *= sign;
    const auto coordinates = ListCoordinates(baseline_, arm_.scale, {body}, 0);
    ASSERT_EQ(coordinates.size(), 5u);
    const Coordinate& inertia = coordinates[4];
    const double bound = sign > 0 ? inertia.low : inertia.high;
    EXPECT_EQ(bound, 0);
    EXPECT_EQ(inertia.Value(inertia.Inverse(bound)), 0);
    EXPECT_TRUE(std::isinf(sign > 0 ? inertia.high : inertia.low));
    EXPECT_TRUE(std::isinf(coordinates[0].low));
  }
}

TEST_F(GapCoordinatesTest, StartsAtTheValueAndKnowsItsBounds) {
  for (const char* name : {"stribeck", "cable", "elasticity"}) {
    for (const Coordinate& c : Of(name)) {
      SCOPED_TRACE(name);
      EXPECT_EQ(c.Value(1), 1);
      const double u = 1.25, h = 1e-6;
      EXPECT_NEAR(c.Slope(u), (c.Value(u + h) - c.Value(u - h)) / (2 * h),
                  1e-6 * std::abs(c.Slope(u)));
      EXPECT_NEAR(c.Inverse(c.Value(u)), u, 1e-12);
      EXPECT_EQ(c.AtBound(1), c.low >= 1 || c.high <= 1);
      if (std::isfinite(c.low)) {
        EXPECT_TRUE(c.AtBound(c.Inverse(c.low)));
        EXPECT_EQ(c.Value(c.Inverse(c.low)), c.low);
      }
    }
  }
}

}  // namespace armcal::coordinates_test
