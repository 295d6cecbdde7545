#include "problems/inertial_prior.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "problems/inertial_coordinates.h"
#include "problems/inertial_manifold.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::inertial_prior_test {

using Eigen::Matrix4d;
using RowMajor10d = Eigen::Matrix<double, 10, 10, Eigen::RowMajor>;

struct Bodies {
  Vector10d V_0, c, V;  // the file's, and another
};

Bodies RandomBodies(std::mt19937_64* random, double distance) {
  Robot robot = SampleRobot("3R elbow");
  SetRandomInertials(random, &robot);
  Bodies bodies;
  bodies.V_0 = robot.links[0].inertial.ToVector();
  bodies.c = LogCholeskyFromInertial(bodies.V_0, 0, 0) +
             UniformVector(random, 10, -distance, distance);
  InertialFromLogCholesky(bodies.c.data(), bodies.V.data());
  return bodies;
}

Vector10d Residual(const InertialPrior& prior, const Vector10d& c,
                   RowMajor10d* J = nullptr) {
  const double* blocks[] = {c.data()};
  double* jacobians[] = {J == nullptr ? nullptr : J->data()};
  Vector10d r;
  EXPECT_TRUE(
      prior.Evaluate(blocks, r.data(), J == nullptr ? nullptr : jacobians));
  return r;
}

TEST(InertialPrior, IsTheLogDeterminantDivergence) {
  std::mt19937_64 random(1);
  for (const double distance : {1e-4, .01, .3, 2.}) {
    const Bodies b = RandomBodies(&random, distance);
    const Matrix4d X = PseudoInertia(b.V_0).inverse() * PseudoInertia(b.V);
    const double divergence = X.trace() - std::log(X.determinant()) - 4;
    const InertialPrior prior(b.V_0, .25);
    EXPECT_NEAR(Residual(prior, b.c).squaredNorm() / (32 * divergence), 1,
                1e-9 + 1e-12 / divergence);
  }
}

TEST(InertialPrior, NearTheFileItIsTheRelativeDeviation) {
  std::mt19937_64 random(2);
  const Bodies b = RandomBodies(&random, 1e-5);
  const InertialPrior prior(b.V_0, .25);
  EXPECT_NEAR(Residual(prior, b.c).norm() / (prior.W() * (b.V - b.V_0)).norm(),
              1, 1e-4);
}

TEST(InertialPrior, JacobianMatchesDifferences) {
  std::mt19937_64 random(3);
  for (const double distance : {1e-4, .01, .3, 1.}) {
    const Bodies b = RandomBodies(&random, distance);
    const InertialPrior prior(b.V_0, .25);
    RowMajor10d J;
    Residual(prior, b.c, &J);
    for (int k = 0; k < 10; ++k) {
      const Vector10d h = 1e-6 * Vector10d::Unit(k);
      const Vector10d difference =
          (Residual(prior, b.c + h) - Residual(prior, b.c - h)) / 2e-6;
      EXPECT_LE((J.col(k) - difference).norm(), 1e-6 * J.norm()) << distance;
    }
  }
}

TEST(InertialManifold, StepsAreStraightInTheInertia) {
  std::mt19937_64 random(4);
  const Bodies b = RandomBodies(&random, .3);
  const InertialManifold manifold;
  const Vector10d delta = UniformVector(&random, 10, -.15, .15);
  Vector10d half, full, V_half, V_full, back;
  ASSERT_TRUE(manifold.Plus(b.c.data(), delta.data(), full.data()));
  const Vector10d half_delta = delta / 2;
  ASSERT_TRUE(manifold.Plus(b.c.data(), half_delta.data(), half.data()));
  InertialFromLogCholesky(half.data(), V_half.data());
  InertialFromLogCholesky(full.data(), V_full.data());
  EXPECT_LE((b.V + V_full - 2 * V_half).norm(), 1e-12 * b.V.norm());
  ASSERT_TRUE(manifold.Minus(full.data(), b.c.data(), back.data()));
  EXPECT_LE((back - delta).norm(), 1e-12);
}

TEST(InertialManifold, JacobiansMatchDifferences) {
  std::mt19937_64 random(5);
  const Bodies b = RandomBodies(&random, .3);
  const InertialManifold manifold;
  RowMajor10d plus, minus;
  ASSERT_TRUE(manifold.PlusJacobian(b.c.data(), plus.data()));
  ASSERT_TRUE(manifold.MinusJacobian(b.c.data(), minus.data()));
  EXPECT_LE((minus * plus - RowMajor10d::Identity()).norm(), 1e-10);
  for (int k = 0; k < 10; ++k) {
    const Vector10d h = 1e-6 * Vector10d::Unit(k), back = -h;
    Vector10d right, left;
    manifold.Plus(b.c.data(), h.data(), right.data());
    manifold.Plus(b.c.data(), back.data(), left.data());
    EXPECT_LE((plus.col(k) - (right - left) / 2e-6).norm(), 1e-8);
  }
}

// However long the step: a body that can exist.
TEST(InertialManifold, NeverLeavesWhatCanExist) {
  std::mt19937_64 random(6);
  const InertialManifold manifold;
  for (const double size : {1., 10., 1e6}) {
    for (int run = 0; run < 20; ++run) {
      const Bodies b = RandomBodies(&random, .3);
      const Vector10d delta = UniformVector(&random, 10, -size, size);
      Vector10d c, V;
      ASSERT_TRUE(manifold.Plus(b.c.data(), delta.data(), c.data()));
      InertialFromLogCholesky(c.data(), V.data());
      EXPECT_EQ(WhyUnphysical(InertialParameters::FromVector(V)), "") << size;
    }
  }
}

}  // namespace armcal::inertial_prior_test
