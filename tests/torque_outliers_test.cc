// Gross errors in single torque samples of simulated arms, whose truth is
// known: 5 % of them 20 noise deviations too high, at noise of 1 % of the
// torque, hence smaller than what motion and friction do.

#include "calib/torque_outliers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <set>

#include "tests/calibrate_logs.h"
#include "tests/physical_runs.h"

namespace armcal {
namespace {

using Eigen::VectorXd;
using Samples = std::set<std::pair<long, int>>;  // line of the file, joint

constexpr double kNoiseShare = .01;
constexpr double kOutlierShare = .05;
constexpr double kOutlierSize = 20;  // noise deviations

struct Recording {
  Robot robot;
  Log clean, spoiled;
  Samples planted;
  VectorXd noise;
};

Recording Record(const std::string& name, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const SimulatedArm arm = MakeArm(name, .3, &random);
  Recording run{arm.file, MoveArm(arm.truth, 30, &random), {}, {}, {}};
  run.noise = kNoiseShare * ColumnRms(run.clean.tau);
  AddNoise(&random, VectorXd::Constant(6, 2e-5), &run.clean.q);
  AddNoise(&random, run.noise, &run.clean.tau);
  run.spoiled = run.clean;
  for (int k = 0; k < run.clean.size(); ++k) {
    for (int j = 0; j < 6; ++j) {
      if (Uniform(&random, 0, 1) >= kOutlierShare) continue;
      run.spoiled.tau(k, j) += kOutlierSize * run.noise[j];
      run.planted.insert({k + 2, j});
    }
  }
  return run;
}

struct Calibrated {
  LinearCalibration result;
  Samples listed;
};

Calibrated CalibrateAndList(const Robot& robot, const Log& log,
                            const LinearCalibrationOptions& options) {
  LogReaderOptions reader;
  reader.joint_names = robot.JointNames();
  LogSet set({WriteFile(LogCsv(log))}, reader, {});
  Calibrated c{CalibrateLinear(robot, options, &set, nullptr), {}};
  for (const auto& list : set.outliers()) {
    for (const TorqueOutlier& o : list) {
      c.listed.insert({o.row, o.joint});
      EXPECT_EQ(o.recorded, log.tau(o.row - 2, o.joint));
      EXPECT_NEAR(o.time, log.t[o.row - 2], 1e-9);
    }
  }
  return c;
}

// rms and largest move of the parameters in standard deviations of `from`.
std::pair<double, double> Moves(const LinearCalibration& from,
                                const LinearCalibration& to) {
  const VectorXd moves = (to.x - from.x).cwiseQuotient(from.stddev);
  return {moves.norm() / std::sqrt(static_cast<double>(moves.size())),
          moves.cwiseAbs().maxCoeff()};
}

class TorqueOutliers : public testing::TestWithParam<const char*> {};

TEST_P(TorqueOutliers, MoveLittleAndAreListed) {
  double rms_sum = 0;
  constexpr int kRuns = 2;
  for (int seed = 1; seed <= kRuns; ++seed) {
    const Recording run = Record(GetParam(), seed);
    LinearCalibrationOptions options;
    const auto clean = CalibrateAndList(run.robot, run.clean, options);
    const auto spoiled = CalibrateAndList(run.robot, run.spoiled, options);
    ASSERT_TRUE(clean.result.solved && spoiled.result.solved);
    options.loss = RobustLoss::kSquared;
    const auto squared = CalibrateAndList(run.robot, run.spoiled, options);
    const auto [rms, largest] = Moves(clean.result, spoiled.result);
    const auto [squared_rms, squared_largest] =
        Moves(clean.result, squared.result);
    double right = 0;
    for (const auto& sample : spoiled.listed) {
      right += static_cast<double>(run.planted.count(sample));
    }
    const double recall = right / static_cast<double>(run.planted.size());
    const double precision = right / static_cast<double>(spoiled.listed.size());
    std::printf(
        "%s %d: moves %.3f rms, %.3f largest; squared %.1f, %.1f; recall %.4f, "
        "precision %.4f; %zu listed of the clean log; %d passes\n",
        GetParam(), seed, rms, largest, squared_rms, squared_largest, recall,
        precision, clean.listed.size(), spoiled.result.passes);
    EXPECT_LE(rms, .35);
    EXPECT_LE(largest, 1);
    EXPECT_GE(squared_rms, 4);
    EXPECT_TRUE(squared.listed.empty());
    EXPECT_GE(recall, .99);
    EXPECT_GE(precision, .99);
    EXPECT_TRUE(clean.listed.empty());
    rms_sum += rms;
  }
}

INSTANTIATE_TEST_SUITE_P(Arms, TorqueOutliers,
                         testing::Values("UR5 6R", "PUMA560 6R"));

}  // namespace
}  // namespace armcal
