#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <random>
#include <string>

#include "calib/closed_loop/output_error.h"
#include "tests/fixtures/commanded_arm.h"

namespace armcal::output_error_long_test {

// Of arms of Simbody with one, three and six joints in position loops, logs of
// 30 s: how often intervals of 95 % hold the truth, and how far off estimates
// are in the mean, in deviations. Gains are those of the file or, with `gains`,
// estimated from it with that relative deviation.
struct Study {
  int joints, draws;
  double gains, bandwidth_hz;
  Encoder encoder;
  double torque_noise = 0;  // N m, of a second log with torques; 0: none
};

class OutputErrorStudy : public testing::TestWithParam<Study> {};
// Six joints in loops of 8 Hz are all but unstable: linearised, they amplify an
// encoder's noise a thousandfold, which is no loop that one would run.
INSTANTIATE_TEST_SUITE_P(Arms, OutputErrorStudy,
                         testing::Values(Study{1, 200, 0, 8, kUsualEncoder},
                                         Study{1, 200, .1, 8, kUsualEncoder},
                                         Study{3, 100, 0, 8, kUsualEncoder},
                                         Study{6, 100, 0, 4, kUsualEncoder},
                                         Study{1, 200, .3, 8, kUsualEncoder,
                                               .1},
                                         Study{1, 200, 0, 8, kCoarseEncoder},
                                         Study{3, 100, 0, 8, kCoarseEncoder}));

TEST_P(OutputErrorStudy, IntervalsHoldTheTruth) {
  const Study study = GetParam();
  const Robot truth = CommandedTruth(study.joints);
  const ControllerOptions controller =
      CommandedController(truth, study.bandwidth_hz);
  auto expected = TrueValues(truth);
  for (int j = 0; j < study.joints && study.gains > 0; ++j) {
    const std::string name = truth.links[j].joint.name;
    expected[name + ".kp"] = controller.drives[j].kp;
    expected[name + ".kd"] = controller.drives[j].kd;
    expected[name + ".ki"] = controller.drives[j].ki;
  }
  std::mt19937_64 random(9);
  std::normal_distribution<double> normal;
  std::map<std::string, double> sums, squares;
  int inside = 0, all = 0;
  for (int draw = 0; draw < study.draws; ++draw) {
    ControllerOptions file = controller;
    for (double DriveLaw::*gain :
         {&DriveLaw::kp, &DriveLaw::kd, &DriveLaw::ki}) {
      for (DriveLaw& drive : file.drives) {
        drive.*gain *= 1 + study.gains * normal(random);
      }
    }
    OutputErrorOptions options;
    options.trust.inertia = 0;
    options.trust.gains = study.gains;
    const auto record = [&](int seed) {
      return RecordCommands(truth, controller, 30, study.encoder, seed);
    };
    std::optional<TorqueInformation> torques;
    if (study.torque_noise > 0) {
      torques = TorquesOf(record(draw + 1001), FileOf(truth),
                          study.torque_noise, draw + 1);
      ASSERT_EQ(torques->reason, "");
    }
    const OutputErrorCalibration result =
        CalibrateOutputError(FileOf(truth), file, options, {record(draw + 1)},
                             {}, torques ? &*torques : nullptr);
    ASSERT_TRUE(result.arm.converged()) << result.arm.reason;
    for (const PhysicalParameter& p : result.arm.parameters) {
      const auto value = expected.find(p.name);
      if (value == expected.end()) continue;
      const double error = (p.value - value->second) / p.stddev;
      inside += std::abs(error) < 1.96;
      ++all;
      sums[p.name] += error;
      squares[p.name] += error * error;
    }
  }
  for (const auto& [name, sum] : sums) {
    const double mean = sum / study.draws;
    std::printf("%-18s bias %6.2f rms %5.2f\n", name.c_str(), mean,
                std::sqrt(squares[name] / study.draws));
    EXPECT_LT(std::abs(mean), .5 + 2 / std::sqrt(study.draws)) << name;
  }
  const double share = static_cast<double>(inside) / all;
  std::printf("inside %.3f of %d\n", share, all);
  const double chance = 2 * std::sqrt(.95 * .05 / study.draws);
  EXPECT_NEAR(share, .95, .02 + chance);
}

}  // namespace armcal::output_error_long_test
