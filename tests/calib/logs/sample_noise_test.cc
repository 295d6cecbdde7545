#include "calib/logs/sample_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calib/logs/repeated_motion.h"
#include "tests/fixtures/calibrate_logs.h"
#include "tests/fixtures/nonlinear_runs.h"

namespace armcal::sample_noise_test {

using Eigen::VectorXd;
using Source = SampleNoise::Source;

constexpr double kPeriod = 7.313;  // s, no multiple of any step

Multisine PeriodicMotion(std::mt19937_64* random) {
  Multisine motion = RandomMultisine(random, 6, 1.2);
  const double slowest = 2 * M_PI / kPeriod;
  motion.omega =
      slowest * (motion.omega / slowest).array().round().max(1).matrix();
  return motion;
}

class Noise : public testing::Test {
 protected:
  Noise() : arm_(MakeArm("UR5 6R", .3, &random_)) {}

  // `unmodelled`: a torque of the position, in shares of the noise.
  void AddTorques(double unmodelled, Log* log) {
    AddTorque(arm_.truth, log);
    if (sigma_.size() == 0) sigma_ = .01 * ColumnRms(log->tau);
    for (int j = 0; j < 6; ++j) {
      log->tau.col(j).array() +=
          unmodelled * sigma_[j] * (9 * log->q.col(j).array()).sin();
    }
    AddNoise(&random_, sigma_, &log->tau);
    AddNoise(&random_, VectorXd::Constant(6, 2e-5), &log->q);
  }
  void Expect(const LinearCalibration& result, Source source, double within) {
    ASSERT_EQ(result.sample_noise.size(), 6u);
    for (int j = 0; j < 6; ++j) {
      EXPECT_EQ(NoiseSourceName(result.sample_noise[j].source),
                NoiseSourceName(source));
      EXPECT_NEAR(result.sample_noise[j].stddev / sigma_[j], 1, within) << j;
    }
  }
  LinearCalibration Calibrated(const std::vector<Log>& logs) {
    LinearCalibrationOptions options;
    options.joint_terms = {JointTerm::kViscous, JointTerm::kArmature};
    return CalibrateLogs(arm_.file, logs, options);
  }

  std::mt19937_64 random_{7};
  SimulatedArm arm_;
  VectorXd sigma_;  // of the torque
};

// What the model lacks is four times the noise, and the same every period.
TEST_F(Noise, OfRepeatsIsNotTheModelsError) {
  Log log = RecordMotion(PeriodicMotion(&random_), 25, .01);
  AddTorques(4, &log);
  Expect(Calibrated({log}), Source::kRepeats, .1);
}

TEST_F(Noise, OfRepeatsAcrossLogs) {
  const Multisine motion = PeriodicMotion(&random_);
  std::vector<Log> logs;
  for (int k = 0; k < 2; ++k) {
    logs.push_back(RecordMotion(motion, 7, .01));
    AddTorques(4, &logs.back());
  }
  Expect(Calibrated(logs), Source::kRepeats, .15);
}

TEST_F(Noise, OfStandstill) {
  Log log = RecordMotion(RandomMultisine(&random_, 6, 1.2), 25, .01);
  for (int k = 2000; k < log.size(); ++k) {
    log.q.row(k) = log.q.row(2000);
    log.qd.row(k).setZero();
    log.qdd.row(k).setZero();
  }
  AddTorques(4, &log);
  Expect(Calibrated({log}), Source::kStandstill, .15);
}

// Of a right model the residual is the noise, of a wrong one more.
TEST_F(Noise, OfTheResidualElse) {
  const Log motion = RecordMotion(RandomMultisine(&random_, 6, 1.2), 25, .01);
  Log right = motion, wrong = motion;
  AddTorques(0, &right);
  Expect(Calibrated({right}), Source::kResidual, .1);
  AddTorques(4, &wrong);
  for (const SampleNoise& noise : Calibrated({wrong}).sample_noise) {
    EXPECT_EQ(noise.source, Source::kResidual);
  }
}

RecordedMotion Recorded(const Multisine& motion, double begin, double end,
                        double dt) {
  const Log log = RecordMotion(motion, end, dt);
  const int rows = static_cast<int>(log.size() - std::lround(begin / dt));
  return {log.t.tail(rows), log.q.bottomRows(rows)};
}

TEST(FindRepeat, FindsThePeriod) {
  std::mt19937_64 random(5);
  const Multisine motion = PeriodicMotion(&random);
  for (const double dt : {.001, .0137}) {
    const RecordedMotion whole = Recorded(motion, 0, 22, dt);
    const auto lag = FindRepeat(whole, whole, .5);
    ASSERT_TRUE(lag);
    EXPECT_NEAR(*lag, kPeriod, dt);
  }
  const RecordedMotion once = Recorded(motion, 0, kPeriod + 1, .01);
  EXPECT_FALSE(FindRepeat(once, once, .5));  // too short a part comes again
  // The same in another log, which began 3 s later in the motion.
  const RecordedMotion late = Recorded(motion, 3, 10, .01);
  const auto same = FindRepeat(once, late, -1e9);
  ASSERT_TRUE(same);
  EXPECT_NEAR(*same, 0, .01);
}

TEST(FindRepeat, IsNotFooledByOtherMotionOrRest) {
  std::mt19937_64 random(6);
  const RecordedMotion one = Recorded(RandomMultisine(&random, 6), 0, 20, .01);
  const RecordedMotion two = Recorded(RandomMultisine(&random, 6), 0, 20, .01);
  EXPECT_FALSE(FindRepeat(one, one, .5));
  EXPECT_FALSE(FindRepeat(one, two, -1e9));
  RecordedMotion rest = one;
  rest.q.setConstant(.3);
  EXPECT_FALSE(FindRepeat(rest, rest, .5));
  RecordedMotion home = one;  // begins and ends at rest at the same place
  home.q.topRows(400).setConstant(.3);
  home.q.bottomRows(400).setConstant(.3);
  EXPECT_FALSE(FindRepeat(home, home, .5));
}

}  // namespace armcal::sample_noise_test
