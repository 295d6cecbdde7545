// Points that the tool touches in many postures, and nothing else.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "calib/poses/calibrate_poses.h"
#include "tests/fixtures/touching_arm.h"

namespace armcal::touches_test {

using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::Contains;
using testing::HasSubstr;

constexpr double kTouch = 1e-4;  // m

PoseMeasurements Touch(TouchingArm* arm, const std::vector<Vector3d>& points,
                       int times, double noise) {
  PoseMeasurements m;
  m.q.resize(static_cast<int>(points.size()) * times, 6);
  for (int k = 0; k < m.q.rows(); ++k) {
    const int point = k % static_cast<int>(points.size());
    auto* random = &arm->random;
    m.q.row(k) = arm->Reach(
        [&, missed = Vector3d(noise * Vector3d(Normal(random), Normal(random),
                                               Normal(random)))](
            const Vector3d& tip) -> VectorXd {
          return tip - points[point] - missed;
        });
    m.row.push_back(k + 2);
    m.touched.push_back(point);
  }
  return m;
}

// What is left of exact ones is what no touch can tell: nothing.
TEST(Touches, ExactOnesAreExplained) {
  TouchingArm touching(1);
  const auto c = CalibratePoses(
      touching.file, Touch(&touching, {{-.45, .2, .1}}, 40, 0), RefineAll());
  ASSERT_TRUE(c.solved) << c.reason;
  EXPECT_LT(c.rms, 1e-6);
  EXPECT_GT(c.before_rms, 5e-4);
}

// Where the arm stands and how long a metre is no touch tells, nor where on the
// last axis the tip's frame is.
TEST(Touches, WhatNobodyCanTellIsHeld) {
  TouchingArm touching(2);
  const auto c = CalibratePoses(
      touching.file,
      Touch(&touching, {{-.45, .2, .1}, {.4, .3, .2}}, 30, kTouch),
      RefineAll());
  ASSERT_TRUE(c.solved) << c.reason;
  EXPECT_THAT(c.held, Contains(HasSubstr("touches tell no scale")));
  for (const GeometryEstimate& p : c.parameters) {
    EXPECT_NE(p.name.rfind("base.", 0), 0u);
    EXPECT_TRUE(p.identifiable) << p.name;
    EXPECT_LT(p.stddev, p.unit == "m" ? 2e-3 : 5e-3) << p.name;
  }
}

// A hundred arms (ten scatter by a tenth) that touch one point forty times with
// errors of 0.1 mm: the tool's error elsewhere, in the mean square, falls to
// less than a sixth. How long a metre is the file says, by all of its lengths.
TEST(Touches, OfOnePointMakeAnArmSixTimesAsGood) {
  double before = 0, tool_alone = 0, after = 0;
  for (int seed = 101; seed <= 200; ++seed) {
    TouchingArm touching(seed);
    const auto touches = Touch(&touching, {{-.45, .2, .1}}, 40, kTouch);
    PoseCalibrationOptions frame = RefineAll();
    frame.refine = RefineGeometry::kNothing;
    const auto alone = CalibratePoses(touching.file, touches, frame);
    const auto all = CalibratePoses(touching.file, touches, RefineAll());
    ASSERT_TRUE(alone.solved && all.solved);
    before += std::pow(touching.ToolError(touching.file), 2) / 100;
    tool_alone += std::pow(touching.ToolError(alone.robot), 2) / 100;
    after += std::pow(touching.ToolError(all.robot), 2) / 100;
  }
  std::printf(
      "rms of a hundred arms, mm: file %.2f, its tool estimated %.2f, all "
      "of it %.2f\n",
      1e3 * std::sqrt(before), 1e3 * std::sqrt(tool_alone),
      1e3 * std::sqrt(after));
  EXPECT_LT(std::sqrt(after), std::sqrt(before) / 6);
}

}  // namespace armcal::touches_test
