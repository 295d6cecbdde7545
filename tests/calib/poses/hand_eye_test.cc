#include "calib/poses/hand_eye.h"

#include <gtest/gtest.h>

#include <random>

#include "model/robot/kinematics.h"
#include "tests/fixtures/sample_motion.h"

namespace armcal::hand_eye_test {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Vector3d RandomVector(std::mt19937_64* random) {
  return {Normal(random), Normal(random), Normal(random)};
}

Isometry3d RandomFrame(std::mt19937_64* random) {
  Isometry3d X = Isometry3d::Identity();
  const Vector3d turn = RandomVector(random);
  X.linear() =
      Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  X.translation() = RandomVector(random);
  return X;
}

// Frames that are nowhere near the identity.
TEST(HandEye, FindsBothFramesOfExactPoses) {
  for (int seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 random(seed);
    const Isometry3d X_WB = RandomFrame(&random), X_ET = RandomFrame(&random);
    std::vector<Isometry3d> flange, seen;
    for (int k = 0; k < 4; ++k) {
      flange.push_back(RandomFrame(&random));
      seen.push_back(X_WB * flange.back() * X_ET);
    }
    const auto frames = SolveHandEye(flange, seen);
    ASSERT_TRUE(frames);
    EXPECT_TRUE(frames->X_WB.isApprox(X_WB, 1e-9)) << seed;
    EXPECT_TRUE(frames->X_ET.isApprox(X_ET, 1e-9)) << seed;
  }
}

// Turning about one axis tells no rotation about it.
TEST(HandEye, OneAxisIsNotEnough) {
  std::mt19937_64 random(3);
  const Isometry3d X_WB = RandomFrame(&random), X_ET = RandomFrame(&random);
  std::vector<Isometry3d> flange, seen;
  for (int k = 0; k < 6; ++k) {
    Isometry3d X = Isometry3d::Identity();
    X.linear() =
        Eigen::AngleAxisd(.3 * k, Vector3d::UnitZ()).toRotationMatrix();
    X.translation() = RandomVector(&random);
    flange.push_back(X);
    seen.push_back(X_WB * X * X_ET);
  }
  EXPECT_FALSE(SolveHandEye(flange, seen));
  EXPECT_FALSE(SolveHandEye({flange[0]}, {seen[0]}));
}

}  // namespace armcal::hand_eye_test
