#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>

#include "calib/poses/calibrate_poses.h"
#include "calib/poses/calibration.h"
#include "tests/fixtures/sample_poses.h"

namespace armcal::calibration_long_test {

// The truth in the terms of the parameters that are not held: what the same
// fit gives without noise and prior.
std::map<std::string, double> Truth(const std::string& name, int run,
                                    Instrument instrument, int poses) {
  Plant plant(name, run);
  PoseCalibrationOptions options;
  options.loss = RobustLoss::kSquared;
  options.prior_length = options.prior_angle = options.folds = 0;
  std::map<std::string, double> truth;
  for (const GeometryEstimate& p :
       CalibratePoses(plant.nominal, plant.Measure(instrument, poses, 0),
                      options)
           .parameters) {
    truth[p.name] = p.value;
  }
  return truth;
}

// 95 % intervals cover the truth, over 100 arms and logs for each instrument.
TEST(PoseCalibrationLong, IntervalsCoverTheTruth) {
  for (const Instrument instrument :
       {Instrument::kTargets, Instrument::kPoses, Instrument::kWire}) {
    const int poses = instrument == Instrument::kWire ? 120 : 60;
    int inside = 0, all = 0;
    for (int run = 0; run < 100; ++run) {
      const std::string name = run % 2 ? "PUMA560 6R" : "UR5 6R";
      Plant plant(name, run);
      PoseCalibrationOptions options;
      options.folds = 0;
      const auto m = plant.Measure(instrument, poses, kNoise);
      const auto truth = Truth(name, run, instrument, poses);
      const auto c = CalibratePoses(plant.nominal, m, options);
      ASSERT_TRUE(c.solved) << c.reason;
      for (const GeometryEstimate& p : c.parameters) {
        if (truth.count(p.name) == 0) continue;
        ++all;
        inside += std::abs(p.value - truth.at(p.name)) < 1.96 * p.stddev;
      }
    }
    const double coverage = static_cast<double>(inside) / all;
    std::printf("coverage %.4f of %d\n", coverage, all);
    EXPECT_GT(all, 1900);
    EXPECT_GT(coverage, .92);
    EXPECT_LT(coverage, .98);
  }
}

}  // namespace armcal::calibration_long_test
