// Monte Carlo runs of CalibrateNonlinear: intervals, and whether fits of every
// difficulty end.

#include <gtest/gtest.h>

#include "tests/fixtures/nonlinear_runs.h"

namespace armcal::nonlinear_calibration_long_test {

struct Scores {
  double sum = 0;
  int count = 0;
  void Add(double z) {
    sum += z * z;
    ++count;
  }
  double rms() const { return std::sqrt(sum / count); }
};

class Intervals : public testing::TestWithParam<const char*> {};

// The truth is drawn from the prior in every run.
TEST_P(Intervals, AreTrue) {
  Scores terms, inertias;
  NonlinearCalibrationOptions options;
  options.trust.inertia = .3;
  for (int run = 0; run < 60; ++run) {
    std::mt19937_64 random(100 + run);
    const SimulatedArm arm =
        MakeArm(GetParam(), options.trust.inertia, &random);
    const auto result = Calibrate(arm, .01, options, &random).physical;
    ASSERT_TRUE(result.solved) << result.reason;
    for (const PhysicalParameter& p : result.parameters) {
      if (!p.identifiable) continue;
      const double z = (p.value - ValueIn(arm.truth, p.name)) / p.stddev;
      (p.name[0] == 'j' ? terms : inertias).Add(z);
    }
  }
  EXPECT_GT(terms.rms(), .7);
  EXPECT_LT(terms.rms(), 1.3);
  EXPECT_GT(inertias.rms(), .7);
  EXPECT_LT(inertias.rms(), 1.3);
  RecordProperty("terms", std::to_string(terms.rms()));
  RecordProperty("inertias", std::to_string(inertias.rms()));
}

INSTANTIATE_TEST_SUITE_P(, Intervals, testing::Values("3R elbow", "UR5 6R"));

class Robots : public testing::TestWithParam<const char*> {};

// The truth is as far from the file as a prior without trust has it, so that
// logs pull links to the boundary of what can exist; noise from one that shows
// every direction to one that hides most.
TEST_P(Robots, AlwaysEnd) {
  for (const double noise : {.0005, .01, .1}) {
    for (const double trust : {.05, .3, 1., 3.}) {
      for (int seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE("noise " + std::to_string(noise) + " trust " +
                     std::to_string(trust) + " seed " + std::to_string(seed));
        std::mt19937_64 random(seed);
        const SimulatedArm arm = MakeArm(GetParam(), 1, &random);
        NonlinearCalibrationOptions options;
        options.trust.inertia = trust;
        const NonlinearRun run = Calibrate(arm, noise, options, &random);
        ASSERT_TRUE(run.physical.solved) << run.physical.reason;
        EXPECT_EQ(run.physical.reason, "CONVERGENCE");
        EXPECT_LE(run.physical.iterations, 50);
        for (const Link& link : run.physical.robot.links) {
          EXPECT_EQ(WhyUnphysical(link.inertial), "") << link.name;
        }
        if (trust < .3) continue;  // wrong trust: the file wins over the logs
        EXPECT_LE(run.physical.validation->moving().stacked_percent,
                  1.05 * run.linear.validation->moving().stacked_percent);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, Robots,
                         testing::Values("3R elbow", "UR5 6R", "Panda 7R"));

}  // namespace armcal::nonlinear_calibration_long_test
