// Planes that the tool touches, each in many postures, and nothing else.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "calib/poses/calibrate_poses.h"
#include "problems/poses/plane_residual.h"
#include "tests/fixtures/touching_arm.h"

namespace armcal::planes_test {

using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::Contains;
using testing::HasSubstr;

// A table and two walls, none of them square to the base; normals and
// distances from the base.
const std::vector<std::pair<Vector3d, double>> kPlanes = {
    {Vector3d(.05, -.03, 1).normalized(), .02},
    {Vector3d(1, .1, .04).normalized(), .45},
    {Vector3d(.08, -1, .02).normalized(), .4}};

PoseMeasurements TouchPlanes(TouchingArm* arm, int times, double noise) {
  PoseMeasurements m;
  m.planes = true;
  m.q.resize(3 * times, 6);
  for (int k = 0; k < m.q.rows(); ++k) {
    const Vector3d& normal = kPlanes[k % 3].first;
    const double distance = kPlanes[k % 3].second;
    const double missed = noise * Normal(&arm->random);
    m.q.row(k) = arm->Reach([&](const Vector3d& tip) -> VectorXd {
      return VectorXd::Constant(1, normal.dot(tip) - distance - missed);
    });
    m.row.push_back(k + 2);
    m.touched.push_back(k % 3);
  }
  return m;
}

TEST(Planes, DerivativesAreThoseOfTheResidual) {
  TouchingArm arm(1);
  const auto geometry = std::make_shared<const ArmGeometry>(arm.file);
  VectorXd g = geometry->Values();
  VectorXd q(6);
  q << .3, -.8, 1.1, .2, .9, -.4;
  for (int axis = 0; axis < 3; ++axis) {
    const PlaneResidual residual(geometry, q, {axis}, .01);
    VectorXd abc = Vector3d(.2, -.3, .4);
    const double* blocks[] = {g.data(), abc.data()};
    double r, moved;
    VectorXd dg(g.size()), dabc(3);
    double* derivatives[] = {dg.data(), dabc.data()};
    ASSERT_TRUE(residual.Evaluate(blocks, &r, derivatives));
    const auto check = [&](VectorXd* x, const VectorXd& d) {
      for (Eigen::Index k = 0; k < x->size(); ++k) {
        const double was = (*x)[k];
        (*x)[k] += 1e-7;
        ASSERT_TRUE(residual.Evaluate(blocks, &moved, nullptr));
        (*x)[k] = was;
        EXPECT_NEAR((moved - r) / 1e-7, d[k], 1e-4 * (1 + std::abs(d[k])));
      }
    };
    check(&g, dg);
    check(&abc, dabc);
  }
}

TEST(Planes, ExactTouchesAreExplained) {
  TouchingArm arm(1);
  const auto c =
      CalibratePoses(arm.file, TouchPlanes(&arm, 40, 0), RefineAll());
  ASSERT_TRUE(c.solved) << c.reason;
  EXPECT_LT(c.rms, 1e-6);
  EXPECT_GT(c.before_rms, 5e-4);
}

// Where the arm stands and how long a metre is no plane tells, either.
TEST(Planes, WhatNobodyCanTellIsHeld) {
  TouchingArm arm(2);
  const auto c =
      CalibratePoses(arm.file, TouchPlanes(&arm, 60, 1e-4), RefineAll());
  ASSERT_TRUE(c.solved) << c.reason;
  EXPECT_THAT(c.held, Contains(HasSubstr("touches tell no scale")));
  for (const GeometryEstimate& p : c.parameters) {
    EXPECT_NE(p.name.rfind("base.", 0), 0u);
    EXPECT_TRUE(p.identifiable) << p.name;
  }
}

// Five arms that touch three planes sixty times each with errors of 0.1 mm.
TEST(Planes, ThreeOfThemMakeAnArmFiveTimesAsGood) {
  double before = 0, after = 0;
  for (int seed = 11; seed <= 15; ++seed) {
    TouchingArm arm(seed);
    const auto c =
        CalibratePoses(arm.file, TouchPlanes(&arm, 60, 1e-4), RefineAll());
    ASSERT_TRUE(c.solved);
    before += std::pow(arm.ToolError(arm.file), 2) / 5;
    after += std::pow(arm.ToolError(c.robot), 2) / 5;
  }
  std::printf("rms of five arms, mm: file %.2f, calibrated %.2f\n",
              1e3 * std::sqrt(before), 1e3 * std::sqrt(after));
  EXPECT_LT(std::sqrt(after), std::sqrt(before) / 5);
}

}  // namespace armcal::planes_test
