#include <ceres/gradient_checker.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "problems/poses/pose_residual.h"
#include "problems/poses/target_residual.h"
#include "problems/poses/tilt_residual.h"
#include "problems/poses/touch_residual.h"
#include "problems/poses/wire_residual.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::residuals_test {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// The largest deviation from Ridders' numeric derivatives. Absolute: at a zero
// rotation some derivatives are zero but for rounding.
double GradientError(const ceres::CostFunction& cost,
                     const std::vector<VectorXd>& blocks) {
  const std::vector<const ceres::Manifold*>* no_manifolds = nullptr;
  ceres::NumericDiffOptions options;
  options.ridders_relative_initial_step_size = 1e-5;
  ceres::GradientChecker checker(&cost, no_manifolds, options);
  std::vector<const double*> parameters;
  for (const VectorXd& block : blocks) parameters.push_back(block.data());
  ceres::GradientChecker::ProbeResults results;
  checker.Probe(parameters.data(), 1e-6, &results);
  EXPECT_TRUE(results.return_value || !results.jacobians.empty());
  double error = 0;
  for (size_t k = 0; k < results.jacobians.size(); ++k) {
    error =
        std::max(error, (results.jacobians[k] - results.numeric_jacobians[k])
                            .cwiseAbs()
                            .maxCoeff());
  }
  return error;
}

VectorXd Residuals(const ceres::CostFunction& cost,
                   const std::vector<VectorXd>& blocks) {
  std::vector<const double*> parameters;
  for (const VectorXd& block : blocks) parameters.push_back(block.data());
  VectorXd r(cost.num_residuals());
  EXPECT_TRUE(cost.Evaluate(parameters.data(), r.data(), nullptr));
  return r;
}

struct Sample {
  explicit Sample(const std::string& name) {
    const Robot robot = SampleRobot(name);
    geometry = std::make_shared<ArmGeometry>(robot);
    q = UniformVector(&random, robot.num_joints(), -2, 2);
    // Away from 0, where steps of numeric derivatives are relative.
    g = geometry->Values() + UniformVector(&random, geometry->size(), .1, .3);
    X_WT = geometry->ToolPose(q, g.data(), nullptr);
  }
  std::mt19937_64 random{7};
  std::shared_ptr<const ArmGeometry> geometry;
  VectorXd q, g;
  Isometry3d X_WT;
};

const char* const kRobots[] = {"PUMA560 6R", "SCARA RRPR", "Panda 7R"};

// Of errors of position by 1 mm and of rotation by 10 mrad.
Matrix6d Whitening() {
  Eigen::Matrix<double, 6, 1> precision;
  precision << 1e3, 1e3, 1e3, 1e2, 1e2, 1e2;
  return precision.asDiagonal();
}

// Of errors that go together, as those of a board seen by a camera.
Matrix6d Correlated() {
  Matrix6d W = 2 * Matrix6d::Identity();
  W.triangularView<Eigen::StrictlyUpper>() = Matrix6d::Constant(.3);
  return W;
}

TEST(TargetResidual, IsTheDeviationInNoiseUnits) {
  Sample s("UR5 6R");
  const Vector3d p_TQ(.1, .2, -.1), off(1e-3, -2e-3, 3e-3);
  const TargetResidual cost(s.geometry, s.q, s.X_WT * p_TQ - off, 2e-3);
  const VectorXd r = Residuals(cost, {s.g, p_TQ});
  EXPECT_LT((r - Vector3d(.5, -1, 1.5)).norm(), 1e-9);
}

TEST(WireResidual, IsTheDeviationInNoiseUnits) {
  Sample s("UR5 6R");
  VectorXd wire(4);
  wire << s.X_WT.translation() + Vector3d(2, -1, 2), .05;
  const WireResidual cost(s.geometry, s.q, 3.04, 2e-3);
  EXPECT_NEAR(Residuals(cost, {s.g, wire})[0], 5, 1e-9);
  // At the anchor itself numbers stay finite.
  wire.head(3) = s.X_WT.translation();
  const double* parameters[] = {s.g.data(), wire.data()};
  VectorXd d_g(s.g.size()), d_wire(4);
  double* jacobians[] = {d_g.data(), d_wire.data()};
  double r;
  EXPECT_TRUE(cost.Evaluate(parameters, &r, jacobians));
  EXPECT_TRUE(std::isfinite(r) && d_g.allFinite() && d_wire.allFinite());
}

TEST(PoseResidual, IsTheDeviationInNoiseUnits) {
  Sample s("UR5 6R");
  const Vector3d axis = Vector3d(1, -2, 3).normalized();
  for (const double angle : {0., 1e-12, 1e-8, 1e-4, .3, 2.9, M_PI - 1e-6}) {
    Isometry3d X_WM = s.X_WT;
    X_WM.translation() -= Vector3d(1e-3, 2e-3, 0);
    X_WM.linear() = AngleAxisd(-angle, axis) * s.X_WT.linear();
    const PoseResidual cost(s.geometry, s.q, X_WM, Whitening());
    const VectorXd r = Residuals(cost, {s.g});
    EXPECT_LT((r.head<3>() - Vector3d(1, 2, 0)).norm(), 1e-9) << angle;
    EXPECT_LT((r.tail<3>() - angle / 1e-2 * axis).norm(), 1e-6) << angle;
  }
}

TEST(TargetResidual, GradientIsRight) {
  for (const char* name : kRobots) {
    Sample s(name);
    for (int trial = 0; trial < 3; ++trial) {
      const TargetResidual cost(s.geometry, s.q,
                                UniformVector(&s.random, 3, -1, 1), .5);
      EXPECT_LT(GradientError(cost, {s.g, UniformVector(&s.random, 3, .1, .2)}),
                1e-8);
    }
  }
}

TEST(TouchResidual, GradientIsRight) {
  for (const char* name : kRobots) {
    Sample s(name);
    const TouchResidual cost(s.geometry, s.q, .5);
    EXPECT_LT(GradientError(cost, {s.g, UniformVector(&s.random, 3, -1, 1)}),
              1e-8);
  }
}

// The tip less the point, in noise units.
TEST(TouchResidual, IsTheDeviationInNoiseUnits) {
  Sample s("UR5 6R");
  const Vector3d point = s.X_WT.translation() - Vector3d(1e-3, 2e-3, 0);
  const TouchResidual cost(s.geometry, s.q, 1e-3);
  EXPECT_LT((Residuals(cost, {s.g, point}) - Vector3d(1, 2, 0)).norm(), 1e-9);
}

TEST(TiltResidual, GradientIsRight) {
  for (const char* name : kRobots) {
    Sample s(name);
    const TiltResidual cost(s.geometry, s.q, {.3, -.8}, .5);
    EXPECT_LT(GradientError(cost, {s.g}), 1e-8) << name;
  }
}

// An axis that rises by asin of its third component, and an error of a
// milliradian at any tilt.
TEST(TiltResidual, IsTheErrorOfAnAngle) {
  Sample s("UR5 6R");
  const Eigen::Vector2d tilt = s.X_WT.linear().row(2).head<2>().array().asin();
  const TiltResidual cost(s.geometry, s.q, tilt - Eigen::Vector2d(1e-6, 0),
                          1e-6);
  EXPECT_LT((Residuals(cost, {s.g}) - Eigen::Vector2d(1, 0)).norm(), 1e-4);
}

TEST(WireResidual, GradientIsRight) {
  for (const char* name : kRobots) {
    Sample s(name);
    for (int trial = 0; trial < 3; ++trial) {
      const WireResidual cost(s.geometry, s.q, .7, .5);
      EXPECT_LT(GradientError(cost, {s.g, UniformVector(&s.random, 4, 1, 2)}),
                1e-8);
    }
  }
}

// Also where the rotation vector is almost zero, and almost half a turn.
TEST(PoseResidual, GradientIsRight) {
  for (const char* name : kRobots) {
    Sample s(name);
    for (const double angle :
         {0., 1e-9, 1e-5, 9e-5, 1.1e-4, .01, .7, 2.5, 3.1, M_PI - .02}) {
      const Vector3d axis = UniformVector(&s.random, 3, -1, 1).normalized();
      Isometry3d X_WM = s.X_WT;
      X_WM.translation() += UniformVector(&s.random, 3, -.2, .2);
      X_WM.linear() = AngleAxisd(angle, axis) * s.X_WT.linear();
      const PoseResidual cost(s.geometry, s.q, X_WM, Correlated());
      EXPECT_LT(GradientError(cost, {s.g}), 1e-7) << name << " " << angle;
    }
  }
}

// What an instrument's unknowns move is no error of the arm's.
TEST(PoseResidual, AnInstrumentsUnknownsMoveWhatItMeasured) {
  Sample s("Panda 7R");
  const Eigen::MatrixXd by =
      UniformVector(&s.random, 24, -1, 1).reshaped(6, 4).eval();
  const VectorXd y = UniformVector(&s.random, 4, -1e-6, 1e-6);
  const VectorXd move = by * y;
  Isometry3d X_WM = s.X_WT;
  X_WM.translation() -= move.head<3>();
  X_WM.linear() =
      AngleAxisd(-move.tail<3>().norm(), move.tail<3>().normalized()) *
      s.X_WT.linear();
  const PoseResidual cost(s.geometry, s.q, X_WM, Correlated(), by);
  EXPECT_LT(Residuals(cost, {s.g, y}).norm(),
            1e-5 * Residuals(cost, {s.g, VectorXd::Zero(4)}).norm());
  EXPECT_LT(GradientError(cost, {s.g, y}), 1e-7);
}

// At exactly half a turn the vector's sign is open; numbers stay finite.
TEST(PoseResidual, HalfATurnIsFinite) {
  Sample s("PUMA560 6R");
  for (const double off : {0., 1e-15, 1e-12, 1e-8, -1e-8}) {
    Isometry3d X_WM = s.X_WT;
    X_WM.linear() = AngleAxisd(M_PI + off, Vector3d::UnitY()) * s.X_WT.linear();
    const PoseResidual cost(s.geometry, s.q, X_WM, Matrix6d::Identity());
    const double* parameters[] = {s.g.data()};
    VectorXd r(6), d(6 * s.g.size());
    double* jacobians[] = {d.data()};
    ASSERT_TRUE(cost.Evaluate(parameters, r.data(), jacobians));
    EXPECT_NEAR(r.tail<3>().norm(), M_PI, 1e-7);
    EXPECT_LT(d.cwiseAbs().maxCoeff(), 1e2);
  }
}

}  // namespace armcal::residuals_test
