#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/fixtures/calibrate_logs.h"
#include "tests/fixtures/monte_carlo.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::calibration_long_test {

using Eigen::VectorXd;

Robot PaperScara() {
  Robot robot = SampleRobot("SCARA RRPR");
  for (const int i : {0, 2, 3}) robot.links[i].zero_inertials = {"hx", "hy"};
  return robot;
}

LinearCalibrationOptions PaperOptions() {
  LinearCalibrationOptions options;
  options.geometry = GeometryKnowledge::kNonzeroLengths;
  options.joint_terms = {};
  options.loss = RobustLoss::kSquared;
  return options;
}

// SCARA, 4 s at 2 ms, encoders with 1e-4 rad, torques with 1 %.
MonteCarlo RunScara(const LinearCalibrationOptions& options, int runs) {
  const Robot robot = PaperScara();
  Log exact = RecordMotion(ScaraMultisine(), 4, .002);
  SetPaperScaraTorque(&exact);
  const VectorXd sigma = .01 * ColumnRms(exact.tau);
  std::mt19937_64 random(17);
  MonteCarlo result(PaperScaraTruth());
  for (int run = 0; run < runs; ++run) {
    Log log = exact;
    AddNoise(&random, VectorXd::Constant(4, 1e-4), &log.q);
    AddNoise(&random, sigma, &log.tau);
    result.Add(CalibrateLogs(robot, {log}, options));
  }
  return result;
}

void ExpectHonest(const MonteCarlo& result) {
  EXPECT_GT(result.honesty().mean(), .78);
  EXPECT_LT(result.honesty().mean(), 1.2);
  EXPECT_GT(result.coverage(), 86);
}

TEST(ScaraInNoise, WeakFormWithoutFilter) {
  LinearCalibrationOptions options = PaperOptions();
  options.bandwidth_hz = 0;
  options.window_s = .5;
  const MonteCarlo result = RunScara(options, 300);
  result.Print("weak, window 0.5 s, no filter");
  EXPECT_LT(std::abs(result.bias_percent()[0]), .02);
  EXPECT_NEAR(result.stddev_percent()[0] / .043, 1, .15);
  EXPECT_NEAR(result.stddev_percent()[2] / .16, 1, .15);
  EXPECT_NEAR(result.stddev_percent()[3] / 3.2, 1, .15);
  ExpectHonest(result);
}

TEST(ScaraInNoise, WeakFormByDefault) {
  const MonteCarlo result = RunScara(PaperOptions(), 300);
  result.Print("weak, default bandwidth and window");
  EXPECT_LT(std::abs(result.bias_percent()[0]), .02);
  EXPECT_NEAR(result.stddev_percent()[0] / .043, 1, .15);
  ExpectHonest(result);
}

TEST(ScaraInNoise, WeakFormWithHuber) {
  LinearCalibrationOptions options = PaperOptions();
  options.loss = RobustLoss::kHuber;
  const MonteCarlo result = RunScara(options, 300);
  result.Print("weak, default, Huber");
  EXPECT_LT(std::abs(result.bias_percent()[0]), .02);
  EXPECT_LT(result.stddev_percent()[0], .043 * 1.15 / std::sqrt(.95));
  ExpectHonest(result);
}

TEST(ScaraInNoise, Differential) {
  LinearCalibrationOptions options = PaperOptions();
  options.identification = Identification::kDifferential;
  options.bandwidth_hz = 15;
  const MonteCarlo result = RunScara(options, 150);
  result.Print("differential, 15 Hz");
  EXPECT_NEAR(result.stddev_percent()[0] / .044, 1, .25);
  EXPECT_NEAR(result.bias_percent()[0], -.064, .03);
  EXPECT_NEAR(result.bias_percent()[2], -.23, .08);
  EXPECT_GT(result.coverage(), 90);
}

// The paper's integral model: velocities at the ends carry the encoder noise.
TEST(ScaraInNoise, ThreeIntervalsOfTheIntegralModel) {
  LinearCalibrationOptions options = PaperOptions();
  options.identification = Identification::kIntegral;
  options.intervals = {{0, .5}, {.5, 1}, {1, 1.5}};
  options.bandwidth_hz = 0;
  options.solver = LinearSolver::kBatch;
  const MonteCarlo result = RunScara(options, 150);
  result.Print("integral, three intervals of 0.5 s, batch");
  EXPECT_NEAR(result.stddev_percent()[0], 20, 6);
}

// Several logs with their own motions: intervals must hold the truth as often
// as they claim.
TEST(SeveralLogs, IntervalsCover) {
  for (const int logs : {1, 2, 3, 6}) {
    std::mt19937_64 random(23);
    Robot robot = SampleRobot("2R planar (vertical plane)");
    SetRandomInertials(&random, &robot);
    for (Link& link : robot.links) link.joint.viscous = .3;
    LinearCalibrationOptions options;
    options.joint_terms = {JointTerm::kViscous, JointTerm::kOffset};
    ModelParameters::Options model;
    model.joint_terms = options.joint_terms;
    std::vector<Log> exact;
    for (int k = 0; k < logs; ++k) {
      exact.push_back(
          RecordMotion(RandomMultisine(&random, 2), 24. / logs, .01));
      AddTorque(robot, &exact.back());
    }
    MonteCarlo result(ModelParameters(robot, model).Values(robot));
    for (int run = 0; run < 200; ++run) {
      std::vector<Log> noisy = exact;
      for (Log& log : noisy) {
        AddNoise(&random, Eigen::Vector2d(1e-4, 1e-4), &log.q);
        AddNoise(&random, Eigen::Vector2d(.3, .1), &log.tau);
      }
      result.Add(CalibrateLogs(robot, noisy, options));
    }
    result.Print((std::to_string(logs) + " logs, 24 s in all").c_str());
    std::printf("  coverage %.1f %%\n", result.coverage());
    EXPECT_GT(result.coverage(), 89) << logs;
    EXPECT_LT(result.coverage(), 99) << logs;
  }
}

}  // namespace armcal::calibration_long_test
