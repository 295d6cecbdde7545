#include "model/robot/inertial_parameters.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace armcal::inertial_parameters_test {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

struct PointMass {
  double mass;
  Vector3d position;
};

// The definitions, summed over point masses: the truth of these tests.
Vector10d Sum(const std::vector<PointMass>& points, const Isometry3d& X_AB) {
  Vector10d sum = Vector10d::Zero();
  for (const PointMass& point : points) {
    const double m = point.mass;
    const Vector3d p = X_AB * point.position;
    const double x = p.x(), y = p.y(), z = p.z();
    Vector10d terms;
    terms << m, m * x, m * y, m * z, m * (y * y + z * z), -m * x * y,
        m * (x * x + z * z), -m * x * z, -m * y * z, m * (x * x + y * y);
    sum += terms;
  }
  return sum;
}

const std::vector<PointMass> kBody = {{1.0, {0.1, -0.2, 0.3}},
                                      {2.0, {0.4, 0.5, -0.6}},
                                      {0.5, {-0.7, 0.2, 0.1}},
                                      {1.5, {0.0, 0.3, 0.9}}};

Isometry3d SomePose() {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = Eigen::AngleAxisd(1.1, Vector3d(1, 2, -3).normalized())
                   .toRotationMatrix();
  X.translation() << 0.7, -1.1, 0.4;
  return X;
}

TEST(InertialParameters, VectorHasPinocchiosOrder) {
  InertialParameters p;
  p.mass = 1;
  p.first_moment << 2, 3, 4;
  p.inertia << 5, 6, 8, 6, 7, 9, 8, 9, 10;
  Vector10d expected;
  expected << 1, 2, 3, 4, 5, 6, 7, 8, 9, 10;
  EXPECT_EQ(p.ToVector(), expected);
  EXPECT_EQ(InertialParameters::FromVector(expected).ToVector(), expected);
  const Matrix3d I = InertialParameters::FromVector(expected).inertia;
  EXPECT_EQ(I, Matrix3d(I.transpose()));
  EXPECT_STREQ(InertialName(0), "mass");
  EXPECT_STREQ(InertialName(5), "Ixy");
  EXPECT_STREQ(InertialName(9), "Izz");
  EXPECT_STREQ(InertialUnit(0), "kg");
  EXPECT_STREQ(InertialUnit(3), "kg m");
  EXPECT_STREQ(InertialUnit(4), "kg m^2");
}

TEST(InertialParameters, ReexpressInAgreesWithPointMasses) {
  const auto body =
      InertialParameters::FromVector(Sum(kBody, Isometry3d::Identity()));
  const Isometry3d X_AB = SomePose();
  EXPECT_TRUE(
      body.ReexpressIn(X_AB).ToVector().isApprox(Sum(kBody, X_AB), 1e-14));
  EXPECT_TRUE(body.ReexpressIn(X_AB)
                  .ReexpressIn(X_AB.inverse())
                  .ToVector()
                  .isApprox(body.ToVector(), 1e-13));
}

// Differences of bodies may be massless and still have a first moment.
TEST(InertialParameters, ReexpressInIsLinear) {
  Vector10d massless;
  massless << 0, 1, -2, 3, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6;
  const Vector10d body = Sum(kBody, Isometry3d::Identity());
  const auto move = [](const Vector10d& v) {
    return InertialParameters::FromVector(v).ReexpressIn(SomePose()).ToVector();
  };
  EXPECT_TRUE(
      move(body + massless).isApprox(move(body) + move(massless), 1e-14));
  EXPECT_GT(move(massless).norm(), 1);
}

// A bar of 3 kg and 2 m along x about its end: m l^2 / 3 = 4.
TEST(InertialParameters, FromCenterOfMassOfABar) {
  const auto bar = InertialParameters::FromCenterOfMass(
      3, Vector3d(1, 0, 0), Vector3d(0, 1, 1).asDiagonal());
  Vector10d expected;
  expected << 3, 3, 0, 0, 0, 0, 4, 0, 0, 4;
  EXPECT_TRUE(bar.ToVector().isApprox(expected, 1e-15));
}

TEST(InertialParameters, AddingJoinsBodies) {
  const Isometry3d I = Isometry3d::Identity();
  auto sum = InertialParameters::FromVector(Sum({kBody[0], kBody[1]}, I));
  sum += InertialParameters::FromVector(Sum({kBody[2], kBody[3]}, I));
  EXPECT_TRUE(sum.ToVector().isApprox(Sum(kBody, I), 1e-15));
}

TEST(WhyUnphysical, RealBodiesAreFine) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<PointMass> points(1 + trial % 5);  // 1, 2: singular inertia
    for (PointMass& point : points) {
      point.mass = 1.001 + uniform(generator);
      for (double& x : point.position) x = 10 * uniform(generator);
    }
    const auto body = InertialParameters::FromVector(Sum(points, SomePose()));
    EXPECT_EQ(WhyUnphysical(body), "") << body.ToVector().transpose();
  }
}

TEST(WhyUnphysical, SaysWhichRuleIsBroken) {
  const auto why = [](double mass, const Vector3d& moments) {
    return WhyUnphysical(InertialParameters::FromCenterOfMass(
        mass, Vector3d(0.5, 0, 0), moments.asDiagonal()));
  };
  EXPECT_EQ(why(0, {1, 1, 1}), "mass 0 kg is not positive");
  EXPECT_EQ(why(-0.3, {1, 1, 1}), "mass -0.3 kg is not positive");
  EXPECT_EQ(why(1, {1, 2, 3.5}),
            "principal moments about the centre of mass 1, 2, 3.5 kg m^2 break "
            "the triangle inequality");
  EXPECT_EQ(why(1, {-0.25, 2, 2}),
            "principal moments about the centre of mass -0.25, 2, 2 kg m^2 are "
            "not all positive");
  EXPECT_EQ(why(1, {NAN, 2, 2}), "a parameter is not finite");
  InertialParameters tiny;
  tiny.mass = 1e-320;
  tiny.first_moment << 1, 0, 0;
  EXPECT_EQ(WhyUnphysical(tiny),
            "mass 9.99989e-321 kg is too small for its first moment");
  EXPECT_EQ(why(1, {1, 2, 3}), "");  // a flat plate: equality
  EXPECT_EQ(why(1, {1, 2, 3 + 1e-8}).substr(0, 17), "principal moments");
}

}  // namespace armcal::inertial_parameters_test
