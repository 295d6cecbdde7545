#include "model/robot_files/inertia_split.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::inertia_split_test {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A body whose mass has the same second moment k^2 along every axis about its
// centre: moments of 2 m k^2.
InertialParameters Ball(double mass, const Vector3d& center, double k) {
  return InertialParameters::FromCenterOfMass(
      mass, center, 2 * mass * k * k * Matrix3d::Identity());
}

void ExpectSum(const InertiaSplit& split, const InertialParameters& total,
               const InertialParameters& fixed,
               const InertialParameters& held) {
  Vector10d sum = split.head.ToVector() + split.held_share * held.ToVector();
  if (split.fixed_keep) sum += fixed.ToVector();
  EXPECT_LE((sum - total.ToVector()).norm(), 1e-14);
}

TEST(SplitInertia, AllKeepTheirsWhereThatIsPossible) {
  const InertialParameters total = Ball(2, Vector3d::Zero(), .1);
  const InertialParameters fixed = Ball(.1, {.05, 0, 0}, .02);
  const InertialParameters held = Ball(.2, {0, .05, 0}, .02);
  const InertiaSplit split = SplitInertia(total, fixed, held);
  EXPECT_TRUE(split.fixed_keep);
  EXPECT_EQ(split.held_share, 1);
  EXPECT_NEAR(split.head.mass, 1.7, 1e-15);
  ExpectSum(split, total, fixed, held);
}

TEST(SplitInertia, FixedLinksGiveWayFirst) {
  const InertialParameters total = Ball(2, Vector3d::Zero(), .1);
  const InertialParameters fixed = Ball(3, {.05, 0, 0}, .02);
  const InertialParameters held = Ball(.2, {0, .05, 0}, .02);
  const InertiaSplit split = SplitInertia(total, fixed, held);
  EXPECT_FALSE(split.fixed_keep);
  EXPECT_EQ(split.held_share, 1);
  EXPECT_EQ(WhyUnphysical(split.head), "");
  ExpectSum(split, total, fixed, held);
}

// Of a ball of mass M and moment k and a point of mass m at the distance d the
// pseudo-inertias are diag(M k^2, M k^2, M k^2, M) and m (d, 0, 0, 1)'s dyad,
// whose ratio has the one eigenvalue m/M (1 + d^2 / k^2).
TEST(SplitInertia, HeldLinksHaveTheLargestShareThatFits) {
  const double M = 1.2, k = .05, m = .4, d = .2;
  const InertialParameters total = Ball(M, Vector3d::Zero(), k);
  const InertialParameters held = Ball(m, {d, 0, 0}, 0);
  const InertiaSplit split = SplitInertia(total, {}, held);
  EXPECT_NEAR(split.held_share, .9 / (m / M * (1 + d * d / (k * k))), 1e-12);
  EXPECT_EQ(WhyUnphysical(split.head), "");
  ExpectSum(split, total, {}, held);
  // With a little more than the ninth tenth to the boundary it could not exist.
  EXPECT_NE(WhyUnphysical(InertialParameters::FromVector(
                total.ToVector() - 1.12 * split.held_share * held.ToVector())),
            "");
}

// What no body has stays so; the head keeps a mass all the same.
TEST(SplitInertia, ATotalThatNoBodyHas) {
  InertialParameters total = Ball(1, Vector3d::Zero(), .1);
  total.inertia(0, 0) = -1;
  const InertialParameters held = Ball(4, {.1, 0, 0}, .1);
  const InertiaSplit split = SplitInertia(total, {}, held);
  EXPECT_NEAR(split.head.mass, .5, 1e-15);
  ExpectSum(split, total, {}, held);
}

}  // namespace armcal::inertia_split_test
