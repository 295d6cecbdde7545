#pragma once

// Gross errors in single torque samples of simulated arms, whose truth is
// known: 5 % of them 20 noise deviations too high, at noise of 1 % of the
// torque, hence smaller than what motion and friction do.

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "calib/linear/calibrate_linear.h"
#include "calib/linear/torque_outliers.h"
#include "tests/fixtures/calibrate_logs.h"
#include "tests/fixtures/nonlinear_runs.h"
#include "tests/fixtures/temp_file.h"

namespace armcal {

using Samples = std::set<std::pair<long, int>>;  // line of the file, joint

inline constexpr double kNoiseShare = .01;
inline constexpr double kOutlierShare = .05;
inline constexpr double kOutlierSize = 20;  // noise deviations

struct Recording {
  Robot robot;
  Log clean, spoiled;
  Samples planted;
  Eigen::VectorXd noise;
};

inline Recording Record(const std::string& name, std::uint64_t seed,
                        double duration = 30) {
  std::mt19937_64 random(seed);
  const SimulatedArm arm = MakeArm(name, .3, &random);
  Recording run{arm.file, MoveArm(arm.truth, duration, &random), {}, {}, {}};
  run.noise = kNoiseShare * ColumnRms(run.clean.tau);
  AddNoise(&random, Eigen::VectorXd::Constant(6, 2e-5), &run.clean.q);
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

inline Calibrated CalibrateAndList(const Robot& robot, const Log& log,
                                   const LinearCalibrationOptions& options) {
  LogReaderOptions reader;
  reader.joint_names = robot.JointNames();
  LogSet set({WriteFile(LogCsv(log))}, reader, {});
  Calibrated c{CalibrateLinear(robot, options, set, nullptr), {}};
  for (const auto& list :
       c.result.preparation.outliers.value_or(OutlierLists())) {
    for (const TorqueOutlier& o : list) {
      c.listed.insert({o.row, o.joint});
      EXPECT_EQ(o.recorded, log.tau(o.row - 2, o.joint));
      EXPECT_NEAR(o.time, log.t[o.row - 2], 1e-9);
    }
  }
  return c;
}

// rms and largest move of the parameters in standard deviations of `from`.
inline std::pair<double, double> Moves(const LinearCalibration& from,
                                       const LinearCalibration& to) {
  const Eigen::VectorXd moves = (to.x - from.x).cwiseQuotient(from.stddev);
  return {moves.norm() / std::sqrt(static_cast<double>(moves.size())),
          moves.cwiseAbs().maxCoeff()};
}

struct Outcome {
  double rms, largest;  // moves, in standard deviations of the clean log's
  double squared_rms;   // the same without robust loss
  double recall, precision;
  size_t listed_of_clean;
};

inline Outcome Compare(const Recording& run) {
  LinearCalibrationOptions options;
  const Calibrated clean = CalibrateAndList(run.robot, run.clean, options);
  const Calibrated spoiled = CalibrateAndList(run.robot, run.spoiled, options);
  options.loss = RobustLoss::kSquared;
  const Calibrated squared = CalibrateAndList(run.robot, run.spoiled, options);
  EXPECT_TRUE(clean.result.solved && spoiled.result.solved);
  EXPECT_TRUE(squared.listed.empty());
  double right = 0;
  for (const auto& sample : spoiled.listed) {
    right += static_cast<double>(run.planted.count(sample));
  }
  const auto [rms, largest] = Moves(clean.result, spoiled.result);
  return {rms,
          largest,
          Moves(clean.result, squared.result).first,
          right / static_cast<double>(run.planted.size()),
          right / static_cast<double>(spoiled.listed.size()),
          clean.listed.size()};
}

}  // namespace armcal
