#include "problems/inertial_coordinates.h"

#include <ceres/gradient_checker.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "problems/inertial_prior.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::inertial_coordinates_test {

using Eigen::Matrix4d;
using Eigen::Vector3d;

Vector10d RandomInertial(std::mt19937_64* random) {
  Robot robot = SampleRobot("2R planar (horizontal)");
  SetRandomInertials(random, &robot);
  return robot.links[0].inertial.ToVector();
}

Vector10d FromCoordinates(const Vector10d& c) {
  Vector10d V;
  InertialFromLogCholesky(c.data(), V.data());
  return V;
}

double Cost(const InertialPrior& prior, const Vector10d& V) {
  const Vector10d c = LogCholeskyFromInertial(V, 1e-9, 1e-9);
  const double* parameters[] = {c.data()};
  Vector10d r;
  EXPECT_TRUE(prior.Evaluate(parameters, r.data(), nullptr));
  return .5 * r.squaredNorm();
}

// V in metres, where the unit of length is `unit` metres.
Vector10d InUnits(const Vector10d& V, double unit) {
  Vector10d scaled = V;
  scaled.segment<3>(1) /= unit;
  scaled.tail<6>() /= unit * unit;
  return scaled;
}

TEST(InertialCoordinates, RoundTrip) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector10d V = RandomInertial(&random);
    const Vector10d c = LogCholeskyFromInertial(V);
    EXPECT_LT((FromCoordinates(c) - V).norm(), 1e-12 * V.norm());
    EXPECT_LT((LogCholeskyFromInertial(FromCoordinates(c)) - c).norm(), 1e-10);
  }
}

// A rod's Cholesky factor is far below what its moments' rounding leaves.
TEST(InertialCoordinates, OfThinRods) {
  std::mt19937_64 random(8);
  for (int trial = 0; trial < 200; ++trial) {
    const double length = std::pow(10, -4 + trial % 9);
    const Vector3d end =
        length * Vector3d(UniformVector(&random, 3, -1, 1)).normalized();
    const Vector10d V =
        InertialParameters::FromCenterOfMass(
            2, UniformVector(&random, 3, -1, 1),
            2 * (end.squaredNorm() * Eigen::Matrix3d::Identity() -
                 end * end.transpose()))
            .ToVector();
    const Vector10d c = LogCholeskyFromInertial(V, 0);
    ASSERT_TRUE(c.allFinite()) << c.transpose();
    EXPECT_LT((FromCoordinates(c) - V).norm(), 1e-12 * V.norm());
  }
}

// P = e^2a U U' as the header's matrix says.
TEST(InertialCoordinates, AreTheCholeskyFactor) {
  std::mt19937_64 random(2);
  const Vector10d c = UniformVector(&random, 10, -1, 1);
  Matrix4d U = Matrix4d::Zero();
  U.diagonal() << std::exp(c[1]), std::exp(c[2]), std::exp(c[3]), 1;
  U(0, 1) = c[4];
  U(1, 2) = c[5];
  U(0, 2) = c[6];
  U.topRightCorner<3, 1>() = c.tail<3>();
  const Matrix4d P = std::exp(2 * c[0]) * U * U.transpose();
  EXPECT_LT((PseudoInertia(FromCoordinates(c)) - P).norm(), 1e-12 * P.norm());
}

TEST(InertialCoordinates, AnyPointIsABodyThatCanExist) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 500; ++trial) {
    const Vector10d V = FromCoordinates(UniformVector(&random, 10, -2, 2));
    const auto body = InertialParameters::FromVector(V);
    EXPECT_EQ(WhyUnphysical(body), "");
    const Eigen::SelfAdjointEigenSolver<Matrix4d> eigen(PseudoInertia(V));
    EXPECT_GT(eigen.eigenvalues()[0], 0);
  }
}

// A box of 6 kg with sides .2, .4, .6 m whose middle lies at p: second moments
// m a^2 / 12 about it; and a ball of radius .3: m r^2 / 5.
TEST(InertialCoordinates, OfSolidBodies) {
  const double m = 6, a = .2, b = .4, c = .6;
  const Vector3d p(.1, -.2, .3);
  Vector10d V;
  V << m, m * p, m * ((b * b + c * c) / 12 + .13), -m * p.x() * p.y(),
      m * ((a * a + c * c) / 12 + .1), -m * p.x() * p.z(), -m * p.y() * p.z(),
      m * ((a * a + b * b) / 12 + .05);
  Vector10d box;
  box << .5 * std::log(m), std::log(a / std::sqrt(12)),
      std::log(b / std::sqrt(12)), std::log(c / std::sqrt(12)), 0, 0, 0, p;
  EXPECT_LT((LogCholeskyFromInertial(V) - box).norm(), 1e-12);
  EXPECT_LT((FromCoordinates(box) - V).norm(), 1e-12);
  Vector10d ball;
  const double I = .4 * m * .09;
  ball << m, 0, 0, 0, I, 0, I, 0, 0, I;
  const Vector10d of_ball = LogCholeskyFromInertial(ball);
  EXPECT_NEAR(of_ball[1], std::log(.3 / std::sqrt(5)), 1e-12);
  EXPECT_LT((FromCoordinates(of_ball) - ball).norm(), 1e-12);
}

TEST(InertialCoordinates, UnphysicalParametersAreMovedInside) {
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 300; ++trial) {
    Vector10d V = UniformVector(&random, 10, -1, 1);
    if (trial % 5 == 0) V[0] = 0;
    if (trial % 7 == 0) V.tail<6>().setZero();
    if (trial % 11 == 0) V.setZero();
    const Vector10d c = LogCholeskyFromInertial(V, .01, .1);
    ASSERT_TRUE(c.allFinite()) << V.transpose();
    const Vector10d inside = FromCoordinates(c);
    EXPECT_EQ(WhyUnphysical(InertialParameters::FromVector(inside)), "");
    EXPECT_GE(inside[0], .1 - 1e-12);
    const Vector3d com = inside.segment<3>(1) / inside[0];
    const Eigen::Matrix3d central =
        PseudoInertia(inside).topLeftCorner<3, 3>() / inside[0] -
        com * com.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(central);
    EXPECT_GT(eigen.eigenvalues()[0], 1e-4 * (1 - 1e-6) - 1e-9);
    if (V[0] > .1) {  // mass and centre of mass were fine
      EXPECT_LT((inside.head<4>() - V.head<4>()).norm(), 1e-12);
    }
  }
}

TEST(InertialCoordinates, IsZeroAtTheFileAndIndependentOfFramesAndUnits) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 50; ++trial) {
    const Vector10d V_0 = RandomInertial(&random), V = RandomInertial(&random);
    const double cost = Cost(InertialPrior(V_0, .2), V);
    EXPECT_LT(Cost(InertialPrior(V_0, .2), V_0), 1e-20);
    EXPECT_NEAR(Cost(InertialPrior(V_0, .1), V), 4 * cost, 1e-9 * cost);
    Eigen::Isometry3d X_AB = Eigen::Isometry3d::Identity();
    X_AB.linear() = RotationFromRpy(UniformVector(&random, 3, -3, 3));
    X_AB.translation() = UniformVector(&random, 3, -.5, .5);
    const auto moved = [&](const Vector10d& v) {
      return InertialParameters::FromVector(v).ReexpressIn(X_AB).ToVector();
    };
    EXPECT_NEAR(Cost(InertialPrior(moved(V_0), .2), moved(V)), cost,
                1e-7 * cost);
    EXPECT_NEAR(Cost(InertialPrior(InUnits(V_0, .1), .2), InUnits(V, .1)), cost,
                1e-7 * cost);
  }
}

// tr(P_0^-1 P) - log det(P_0^-1 P) - 4, whose rest is of third order.
TEST(InertialCoordinates, IsTheLogDetDivergenceToSecondOrder) {
  std::mt19937_64 random(6);
  for (int trial = 0; trial < 20; ++trial) {
    const Vector10d V_0 = RandomInertial(&random);
    const InertialPrior prior(V_0, 1);
    const Vector10d c = LogCholeskyFromInertial(V_0);
    const Vector10d step = UniformVector(&random, 10, -1, 1);
    const auto gap = [&](double e) {
      const Vector10d V = FromCoordinates(c + e * step);
      const Matrix4d ratio = PseudoInertia(V_0).ldlt().solve(PseudoInertia(V));
      const double divergence =
          ratio.trace() - std::log(ratio.determinant()) - 4;
      return std::abs(Cost(prior, V) / divergence - 1);
    };
    EXPECT_LT(gap(1e-3), .05);
    EXPECT_LT(gap(1e-4), .005);
  }
}

TEST(InertialCoordinates, GradientIsRight) {
  std::mt19937_64 random(7);
  const std::vector<const ceres::Manifold*>* no_manifolds = nullptr;
  for (int trial = 0; trial < 10; ++trial) {
    const InertialPrior prior(RandomInertial(&random), 1);
    const Vector10d c = LogCholeskyFromInertial(RandomInertial(&random));
    ceres::NumericDiffOptions options;
    options.ridders_relative_initial_step_size = 1e-3;
    ceres::GradientChecker checker(&prior, no_manifolds, options);
    const double* parameters[] = {c.data()};
    ceres::GradientChecker::ProbeResults results;
    EXPECT_TRUE(checker.Probe(parameters, 1e-6, &results)) << results.error_log;
  }
}

}  // namespace armcal::inertial_coordinates_test
