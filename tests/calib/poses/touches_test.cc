// Points that the tool touches in many postures, and nothing else.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "calib/poses/calibrate_poses.h"
#include "tests/fixtures/sample_poses.h"
#include "tests/fixtures/solved_posture.h"

namespace armcal::touches_test {

using Eigen::Isometry3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::Contains;
using testing::HasSubstr;

constexpr double kTouch = 1e-4;  // m

// An arm whose file is half a millimetre and three milliradians off, and two
// millimetres at the tip, with points before it.
struct Touching {
  explicit Touching(std::uint64_t seed) : random(seed) {
    ArmGeometry geometry(SampleRobot("UR5 6R"));
    VectorXd values = geometry.Values();
    values.tail<6>().head<3>() << .03, -.02, .15;
    geometry.SetValues(values);
    file = geometry.ApplyTo(SampleRobot("UR5 6R"));
    truth = values;
    for (int k = 6; k < geometry.size(); ++k) {
      const bool length = geometry.Units()[k] == "m";
      const double size = geometry.IsTool(k) ? 2e-3 : length ? 5e-4 : 3e-3;
      truth[k] += size * Normal(&random);
    }
  }
  Vector3d Tip(const VectorXd& q) const {
    return ArmGeometry(file).ToolPose(q, truth.data(), nullptr).translation();
  }
  PoseMeasurements Touch(const std::vector<Vector3d>& points, int times,
                         double noise) {
    PoseMeasurements m;
    m.q.resize(static_cast<int>(points.size()) * times, 6);
    for (int k = 0; k < m.q.rows(); ++k) {
      const int point = k % static_cast<int>(points.size());
      std::optional<VectorXd> q;
      while (!q || q->cwiseAbs().maxCoeff() > 2.6) {
        const Vector3d missed =
            noise * Vector3d(Normal(&random), Normal(&random), Normal(&random));
        q = SolvedPosture(
            [&](const VectorXd& at) -> VectorXd {
              return Tip(at) - points[point] - missed;
            },
            UniformVector(&random, 6, -2.4, 2.4));
      }
      m.q.row(k) = q->transpose();
      m.row.push_back(k + 2);
      m.touched.push_back(point);
    }
    return m;
  }

  std::mt19937_64 random;
  Robot file;
  VectorXd truth;
};

// rms of the tips of a robot beside those of the true one, m, but for where
// both stand.
double ToolError(const Robot& robot, Touching* touching) {
  constexpr int kPostures = 200;
  Eigen::Matrix3Xd own(3, kPostures), true_ones(3, kPostures);
  for (int k = 0; k < kPostures; ++k) {
    const VectorXd q = UniformVector(&touching->random, 6, -2.4, 2.4);
    own.col(k) = ToolPose(robot, q).translation();
    true_ones.col(k) = touching->Tip(q);
  }
  const Eigen::Matrix4d X = Eigen::umeyama(own, true_ones, false);
  const MatrixXd left =
      (X * own.colwise().homogeneous()).topRows(3) - true_ones;
  return left.norm() / std::sqrt(kPostures);
}

PoseCalibrationOptions Options(RefineGeometry refine = RefineGeometry::kAll) {
  PoseCalibrationOptions options;
  options.refine = refine;
  return options;
}

// What is left of exact ones is what no touch can tell: nothing.
TEST(Touches, ExactOnesAreExplained) {
  Touching touching(1);
  const auto c = CalibratePoses(
      touching.file, touching.Touch({{-.45, .2, .1}}, 40, 0), Options());
  ASSERT_TRUE(c.solved) << c.reason;
  EXPECT_LT(c.rms, 1e-6);
  EXPECT_GT(c.before_rms, 5e-4);
}

// Where the arm stands and how long a metre is no touch tells, nor where on the
// last axis the tip's frame is.
TEST(Touches, WhatNobodyCanTellIsHeld) {
  Touching touching(2);
  const auto c = CalibratePoses(
      touching.file, touching.Touch({{-.45, .2, .1}, {.4, .3, .2}}, 30, kTouch),
      Options());
  ASSERT_TRUE(c.solved) << c.reason;
  EXPECT_THAT(c.held, Contains(HasSubstr("touches tell no scale")));
  for (const GeometryEstimate& p : c.parameters) {
    EXPECT_NE(p.name.rfind("base.", 0), 0u);
    EXPECT_TRUE(p.identifiable) << p.name;
    EXPECT_LT(p.stddev, p.unit == "m" ? 2e-3 : 5e-3) << p.name;
  }
}

// Ten arms that touch one point forty times with errors of 0.1 mm: the tool's
// error elsewhere, in the mean square, falls to less than a fifth. How long a
// metre is the file says: what its longest link is off by stays.
TEST(Touches, OfOnePointMakeAnArmFiveTimesAsGood) {
  double before = 0, tool_alone = 0, after = 0;
  for (int seed = 11; seed <= 20; ++seed) {
    Touching touching(seed);
    const auto touches = touching.Touch({{-.45, .2, .1}}, 40, kTouch);
    const auto alone = CalibratePoses(touching.file, touches,
                                      Options(RefineGeometry::kNothing));
    const auto all = CalibratePoses(touching.file, touches, Options());
    ASSERT_TRUE(alone.solved && all.solved);
    before += std::pow(ToolError(touching.file, &touching), 2) / 10;
    tool_alone += std::pow(ToolError(alone.robot, &touching), 2) / 10;
    after += std::pow(ToolError(all.robot, &touching), 2) / 10;
  }
  std::printf(
      "rms of ten arms, mm: file %.2f, its tool estimated %.2f, all "
      "of it %.2f\n",
      1e3 * std::sqrt(before), 1e3 * std::sqrt(tool_alone),
      1e3 * std::sqrt(after));
  EXPECT_LT(std::sqrt(after), std::sqrt(before) / 5);
}

}  // namespace armcal::touches_test
