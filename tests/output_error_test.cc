#include "calib/output_error.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/commanded_arm.h"

namespace armcal {
namespace {

constexpr double kNoise = 1e-4;  // rad

// Armature, damping, friction and delay of Simbody's arms, from positions with
// an encoder's noise: within their deviations, which are small.
TEST(OutputErrorTest, FindsWhatPositionsTell) {
  for (const int n : {1, 3}) {
    const Robot truth = CommandedTruth(n);
    const ControllerOptions controller = CommandedController(truth);
    OutputErrorOptions options;
    options.trust.inertia = 0;
    const CommandedLog log =
        RecordCommands(truth, controller, 6, {kNoise, kNoise});
    const OutputErrorCalibration result =
        CalibrateOutputError(FileOf(truth), controller, options, {log}, {log});
    ASSERT_TRUE(result.arm.converged()) << result.arm.reason;
    const auto expected = TrueValues(truth);
    size_t found = 0;
    for (const PhysicalParameter& p : result.arm.parameters) {
      const auto value = expected.find(p.name);
      if (value == expected.end()) continue;
      ++found;
      EXPECT_TRUE(p.identifiable) << p.name;
      EXPECT_LT(p.stddev, .25 * value->second) << p.name;
      EXPECT_NEAR(p.value, value->second, 3.5 * p.stddev) << p.name;
    }
    EXPECT_EQ(found, expected.size());
    EXPECT_NEAR(result.model_error, .97, .1);
    for (int j = 0; j < n; ++j) {
      EXPECT_GT(result.positions.nominal[j], 5 * kNoise);
      EXPECT_LT(result.positions.calibrated[j], 1.2 * kNoise);
      EXPECT_LT(result.positions.validation[j], 1.2 * kNoise);
    }
    // An integral part takes any constant torque.
    EXPECT_EQ(result.arm.unseen.size(), static_cast<size_t>(n));
  }
}

// Without gravity no position tells how large torques are: with gains that are
// not known, all of them could be twice as large.
TEST(OutputErrorTest, ScaleOfTorqueNeedsGainsOrGravity) {
  Robot truth = CommandedTruth(1);
  truth.gravity.setZero();
  const ControllerOptions controller = CommandedController(truth);
  const CommandedLog log =
      RecordCommands(truth, controller, 6, {kNoise, kNoise});
  const auto identifiable = [&](double gains, const std::string& name) {
    OutputErrorOptions options;
    options.trust.gains = gains;
    const OutputErrorCalibration result =
        CalibrateOutputError(FileOf(truth), controller, options, {log}, {});
    EXPECT_TRUE(result.arm.converged()) << result.arm.reason;
    for (const PhysicalParameter& p : result.arm.parameters) {
      if (p.name == name) return p.identifiable;
    }
    ADD_FAILURE() << name;
    return false;
  };
  EXPECT_TRUE(identifiable(0, "joint1.coulomb"));
  EXPECT_FALSE(identifiable(1, "joint1.coulomb"));
  EXPECT_FALSE(identifiable(1, "joint1.kp"));
}

}  // namespace
}  // namespace armcal
