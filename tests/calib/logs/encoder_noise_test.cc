#include "calib/logs/encoder_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::encoder_noise_test {

constexpr double kStep = .002;  // s

LogSet SetOf(const Log& log, const TimeRange& crop = TimeRange()) {
  LogReaderOptions reader;
  reader.joint_names = SampleRobot("2R planar (vertical plane)").JointNames();
  return LogSet({WriteFile(LogCsv(log))}, reader, crop);
}

Log Motion(double duration) {
  std::mt19937_64 random(5);
  const Robot robot = SampleRobot("2R planar (vertical plane)");
  Log log = RecordMotion(RandomMultisine(&random, 2), duration, kStep);
  AddTorque(robot, &log);
  return log;
}

// Density and acceleration of a motion whose noise and derivatives are known.
TEST(EncoderNoise, IsThatOfTheEncodersBesideTheMotion) {
  std::mt19937_64 random(7);
  Log log = Motion(30);
  const Eigen::Vector2d sigma(1e-4, 3e-5);
  AddNoise(&random, sigma, &log.q);
  const EncoderNoise noise = MeasureEncoderNoise(SetOf(log), 8);
  for (int j = 0; j < 2; ++j) {
    EXPECT_NEAR(noise.density[j] / (sigma[j] * sigma[j] * kStep), 1, .05);
    const double exact = log.qdd.col(j).squaredNorm() / log.qdd.rows();
    EXPECT_NEAR(noise.mean_square_acceleration[j] / exact, 1, .03);
    EXPECT_NEAR(noise.travel[j],
                log.q.col(j).maxCoeff() - log.q.col(j).minCoeff(), 1e-12);
  }
}

// Of noise alone nothing is taken for motion.
TEST(EncoderNoise, OfAnArmThatStandsIsNoAcceleration) {
  std::mt19937_64 random(7);
  Log log = Motion(30);
  log.q.setZero();
  AddNoise(&random, Eigen::Vector2d(1e-4, 1e-4), &log.q);
  const EncoderNoise noise = MeasureEncoderNoise(SetOf(log), 8);
  const double made = 6 * 1e-8 / std::pow(1. / 32, 4);  // if it were taken for
  EXPECT_LT(noise.mean_square_acceleration.maxCoeff(), .1 * made);
}

// A cropped log is its crop; a gap is no acceleration.
TEST(EncoderNoise, KnowsCropsAndGaps) {
  Log log = Motion(30);
  const EncoderNoise whole = MeasureEncoderNoise(SetOf(log), 8);
  const int half = static_cast<int>(log.t.size() / 2);
  log.q.bottomRows(half).array() += 50;
  log.t.tail(half).array() += 2;
  const EncoderNoise broken = MeasureEncoderNoise(SetOf(log), 8);
  const EncoderNoise first =
      MeasureEncoderNoise(SetOf(log, {0, log.t[half - 1]}), 8);
  for (int j = 0; j < 2; ++j) {
    EXPECT_NEAR(
        broken.mean_square_acceleration[j] / whole.mean_square_acceleration[j],
        1, .05);
    EXPECT_GT(broken.travel[j], 45);
    EXPECT_LT(first.travel[j], 10);
  }
}

}  // namespace armcal::encoder_noise_test
