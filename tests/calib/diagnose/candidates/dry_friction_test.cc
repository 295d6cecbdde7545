#include "calib/diagnose/candidates/dry_friction.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace armcal::dry_friction_test {

using testing::IsEmpty;
using testing::SizeIs;
using Law = CoulombTransition::Law;

double Force(const JointDrive& drive, double v) {
  double sum = 0;
  for (const SaturatingPart& part : drive.dry) {
    sum += part.force * std::min(1., v / part.width);
  }
  for (const BristleFriction& law : drive.bristles) {
    const double x = v / law.stribeck_velocity;
    sum += law.coulomb + (law.at_rest - law.coulomb) * std::exp(-x * x);
  }
  return sum;
}

// A mixture of widths, one of them negative, and only what it comes to.
TEST(DryFriction, PartsFollowTheCurve) {
  const std::vector<CoulombPart> coulomb = {{5, {Law::kVelocity, .006}},
                                            {-1, {Law::kVelocity, .003}},
                                            {.4, {Law::kVelocity, .024}}};
  JointDrive drive;
  EXPECT_NEAR(SetDryFriction(coulomb, .006, &drive), 4.4, 1e-12);
  EXPECT_THAT(drive.bristles, IsEmpty());
  for (double v = 1e-4; v < 1; v *= 1.3) {
    double expected = 0;
    for (const CoulombPart& part : coulomb) {
      expected += part.force * std::tanh(v / part.transition.width);
    }
    EXPECT_NEAR(Force(drive, v), expected, .06 * 4.4) << v;
  }
  EXPECT_NEAR(Force(drive, 1), 4.4, .005 * 4.4);
  for (const SaturatingPart& part : drive.dry) EXPECT_GT(part.force, 0);
}

// The curve of a Stribeck law is followed as closely as one that only rises; it
// falls where parts are of negative force. Presliding's bristles stay.
TEST(DryFriction, WhatFallsWithSpeedHasPartsThatPush) {
  const std::vector<CoulombPart> coulomb = {{4, {Law::kVelocity, .006}}};
  JointDrive drive;
  drive.bristles = {BristleFriction::Stribeck(1.5, .2, .006), {80, .7, .7}};
  EXPECT_NEAR(SetDryFriction(coulomb, .006, &drive), 4, 1e-12);
  ASSERT_THAT(drive.bristles, SizeIs(1));
  EXPECT_EQ(drive.bristles[0].coulomb, .7);
  for (double v = 1e-4; v < 2; v *= 1.2) {
    const double expected =
        (4 + 1.5 * std::exp(-v * v / .04)) * std::tanh(v / .006);
    EXPECT_NEAR(Force(drive, v), .7 + expected, .025 * 5.5) << v;
  }
  EXPECT_NEAR(Force(drive, 2), 4.7, 1e-9);
  EXPECT_LT(drive.dry.back().force, 0);
  EXPECT_LE(drive.dry.size(), 10);
}

// What yields with displacement has its stiffness.
TEST(DryFriction, YieldingPartsAreBristles) {
  JointDrive drive;
  EXPECT_EQ(SetDryFriction({{3, {Law::kDisplacement, .002}}}, .006, &drive), 0);
  EXPECT_THAT(drive.dry, IsEmpty());
  ASSERT_THAT(drive.bristles, SizeIs(1));
  EXPECT_NEAR(drive.bristles[0].stiffness, 1500, 1e-9);
  EXPECT_EQ(drive.bristles[0].coulomb, 3);
  EXPECT_EQ(drive.bristles[0].at_rest, 3);
}

TEST(DryFriction, NothingPushes) {
  JointDrive drive;
  EXPECT_EQ(SetDryFriction({{-1, {Law::kVelocity, .006}}}, .006, &drive), 0);
  EXPECT_FALSE(drive.HasLaws());
}

}  // namespace armcal::dry_friction_test
