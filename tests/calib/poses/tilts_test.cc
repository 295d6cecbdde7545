// Arms calibrated by an inclinometer on the tool, and nothing else.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "calib/poses/calibrate_poses.h"
#include "tests/fixtures/calibrated_geometry.h"
#include "tests/fixtures/sample_poses.h"

namespace armcal::tilts_test {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::VectorXd;
using testing::Contains;
using testing::HasSubstr;

constexpr double kTilt = 5e-5;  // rad, noise of an angle

// An arm whose zeros and twists are 3 and 1 mrad off its file, on a base that
// leans by 10 mrad, with an inclinometer anywhere on its last link.
struct LevelledArm {
  explicit LevelledArm(std::uint64_t seed)
      : random(seed), file(SampleRobot("UR5 6R")), geometry(file) {
    truth = geometry.Values();
    const auto names = geometry.Names();
    for (int k = 6; k + 6 < geometry.size(); ++k) {
      if (geometry.Units()[k] == "m") continue;
      const bool zero = names[k].find(".theta") != std::string::npos;
      truth[k] += (zero ? 3e-3 : 1e-3) * Normal(&random);
    }
    truth.segment<2>(4) << 7e-3, -8e-3;  // pitch and roll
    truth.tail<3>() << 1.2, -.3, .2;
  }
  Matrix3d Tool(const VectorXd& q, const VectorXd& values) const {
    return geometry.ToolPose(q, values.data(), nullptr).linear();
  }
  PoseMeasurements Measure(int count, double noise) {
    PoseMeasurements m;
    m.q.resize(count, 6);
    m.tilts.resize(count, 2);
    for (int k = 0; k < count; ++k) {
      Matrix3d R;
      do {
        m.q.row(k) = UniformVector(&random, 6, -2.5, 2.5);
        R = Tool(m.q.row(k), truth);
      } while (R(2, 2) < .3 || std::abs(R(2, 0)) > .9 ||
               std::abs(R(2, 1)) > .9);
      for (const int axis : {0, 1}) {
        m.tilts(k, axis) = std::asin(R(2, axis)) + noise * Normal(&random);
      }
      m.row.push_back(k + 2);
    }
    return m;
  }
  PoseCalibration Calibrate(const PoseMeasurements& m) const {
    PoseCalibrationOptions options;
    options.folds = 0;
    return CalibratePoses(file, m, options);
  }
  // rms of the upward direction in the tool's frame at other postures, rad.
  double DirectionError(const PoseCalibration& c) {
    const VectorXd found = CalibratedValues(geometry, c);
    double squares = 0;
    for (int k = 0; k < 200; ++k) {
      const VectorXd q = UniformVector(&random, 6, -2.5, 2.5);
      squares += (Tool(q, found).row(2) - Tool(q, truth).row(2)).squaredNorm();
    }
    return std::sqrt(squares / 200);
  }

  std::mt19937_64 random;
  Robot file;
  ArmGeometry geometry;
  VectorXd truth;
};

TEST(Tilts, ExactOnesAreExplained) {
  LevelledArm arm(1);
  const auto c = arm.Calibrate(arm.Measure(60, 0));
  ASSERT_TRUE(c.solved) << c.reason;
  EXPECT_GT(c.before_rms, 1e-3);
  EXPECT_LT(c.rms, 1e-8);
  EXPECT_LT(arm.DirectionError(c), 1e-7);
  EXPECT_THAT(c.held, Contains(HasSubstr("all lengths")));
  EXPECT_EQ(c.unit, "rad");
}

// What it leaves of the tool's direction is not more than what it measures.
TEST(Tilts, SixtyOfThemLevelAnArm) {
  double squares = 0;
  for (int seed = 11; seed <= 15; ++seed) {
    LevelledArm arm(seed);
    squares +=
        std::pow(arm.DirectionError(arm.Calibrate(arm.Measure(60, kTilt))), 2);
  }
  const double rms = std::sqrt(squares / 5);
  std::printf("direction, rms: %.4f mrad, of angles good to %.4f\n", 1e3 * rms,
              1e3 * kTilt);
  EXPECT_LT(rms, 2 * kTilt);
}

TEST(Tilts, IntervalsHoldTheTruth) {
  IntervalCount held;
  for (int seed = 21; seed <= 50; ++seed) {
    LevelledArm arm(seed), same(seed);
    const auto exact = same.Calibrate(same.Measure(60, 0));
    const auto noisy = arm.Calibrate(arm.Measure(60, kTilt));
    ASSERT_EQ(exact.parameters.size(), noisy.parameters.size());
    // Other postures follow from the same seed: the truth is what exact angles
    // give with the same parameters held.
    held.AddGeometry(noisy, exact);
  }
  std::printf("%d of %d 95 %% intervals hold the truth\n", held.inside,
              held.all);
  // 95 % within three standard deviations of a count whose members are
  // correlated by about a half within an arm.
  EXPECT_GT(held.inside, .91 * held.all);
  EXPECT_LT(held.inside, .98 * held.all);
}

}  // namespace armcal::tilts_test
