#include "calib/linear/weak_window.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calib/linear/calibration_model.h"
#include "model/signals/low_pass.h"
#include "tests/fixtures/calibrate_logs.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::weak_window_test {

using Eigen::ArrayXd;

EncoderNoise Noise(double density, double mean_square_acceleration) {
  EncoderNoise noise;
  noise.density = ArrayXd::Constant(1, density);
  noise.mean_square_acceleration =
      ArrayXd::Constant(1, mean_square_acceleration);
  noise.travel = ArrayXd::Ones(1);
  return noise;
}

constexpr double kBandwidth = 20;

// phi(t) of weak_rows.h at 0, dt, .. of a window of `steps`, int phi dt = 1.
ArrayXd Bump(int steps, double dt) {
  const ArrayXd s = ArrayXd::LinSpaced(steps + 1, -1, 1);
  const ArrayXd bump = (1 - s.square()).pow(4);
  return bump / (bump.sum() * dt);
}

// What white noise of density S makes of int phi'' q dt, q low-passed as logs
// are, is 2e-4 of the acceleration: the sum of squares of what one sample makes
// of all rows, by the filter itself and a test function differenced
// numerically.
TEST(WeakWindow, NoiseIsASmallShareOfTheAcceleration) {
  constexpr double kDensity = 1e-11, kAcceleration = 3;
  const double w = NoiseWindow(Noise(kDensity, kAcceleration), kBandwidth);
  ASSERT_GT(w, .02);
  ASSERT_LT(w, .29);
  constexpr int kSteps = 200, kSize = 4000;
  const double dt = w / kSteps;
  const ArrayXd bump = Bump(kSteps, dt);
  ArrayXd bend = ArrayXd::Zero(kSteps + 1);
  bend.segment(1, kSteps - 1) =
      (bump.tail(kSteps - 1) - 2 * bump.segment(1, kSteps - 1) +
       bump.head(kSteps - 1)) /
      (dt * dt);
  Eigen::MatrixXd one = Eigen::MatrixXd::Zero(kSize, 1);
  one(kSize / 2) = 1;
  const ArrayXd q = ZeroPhaseLowPass(one, 1 / dt, kBandwidth).array();
  double power = 0;
  for (int k = 0; k + kSteps < kSize; ++k) {
    const double row = (bend * q.segment(k, kSteps + 1)).sum() * dt;
    power += row * row;
  }
  EXPECT_NEAR(kDensity / dt * power / (2e-4 * kAcceleration), 1, .01);
}

TEST(WeakWindow, TheJointThatNeedsTheLongestDecides) {
  EncoderNoise two = Noise(1e-11, 3);
  two.density = ArrayXd::Constant(2, 1e-11);
  two.mean_square_acceleration = Eigen::Array2d(3, 1);
  two.travel = ArrayXd::Constant(2, 1.);
  const auto window = [](const EncoderNoise& noise) {
    return NoiseWindow(noise, kBandwidth);
  };
  EXPECT_GT(window(two), 1.1 * window(Noise(1e-11, 3)));
  EXPECT_DOUBLE_EQ(window(two), window(Noise(1e-11, 1)));
  two.travel[1] = 1e-3;  // it does not move
  EXPECT_DOUBLE_EQ(window(two), window(Noise(1e-11, 3)));
}

// Noise that the low pass takes away asks for no window.
TEST(WeakWindow, TheLowPassMayBeEnough) {
  EXPECT_EQ(NoiseWindow(Noise(1e-14, 3), kBandwidth), 0);
  EXPECT_GT(NoiseWindow(Noise(1e-14, 3), 10 * kBandwidth), 0);
}

TEST(WeakWindow, IsNoLongerThanATransitionAllows) {
  EXPECT_EQ(NoiseWindow(Noise(1, 1), kBandwidth), .3);
  EXPECT_EQ(NoiseWindow(Noise(1e-14, 0), kBandwidth), .3);
  EXPECT_EQ(NoiseWindow(Noise(0, 1), kBandwidth), 0);
}

TEST(WeakWindow, AJointWithoutAMotorAsksForTheLongest) {
  EncoderNoise noise = Noise(1e-14, 3);
  noise.torque = Eigen::ArrayXd::Constant(1, .2);
  EXPECT_EQ(NoiseWindow(noise, kBandwidth), 0);
  noise.torque[0] = 0;
  EXPECT_EQ(NoiseWindow(noise, kBandwidth), .3);
  noise.travel[0] = 1e-3;  // it does not move
  EXPECT_EQ(NoiseWindow(noise, kBandwidth), 0);
}

LogSet SetOf(const Robot& robot, const Log& log) {
  LogReaderOptions reader;
  reader.joint_names = robot.JointNames();
  return LogSet({WriteFile(LogCsv(log))}, reader, TimeRange());
}

// |int phi exp(-2 pi i f t) dt|^2 of a window; it is symmetric.
double PowerAt(double f, double window) {
  constexpr int kSteps = 2000;
  const double dt = window / kSteps;
  const ArrayXd t = ArrayXd::LinSpaced(kSteps + 1, -window / 2, window / 2);
  const double gain = (Bump(kSteps, dt) * (2 * M_PI * f * t).cos()).sum() * dt;
  return gain * gain;
}

// Windows pass half of the power at the bandwidth where encoders are good; they
// are long where they are not; as long as was asked for.
TEST(WeakWindow, FollowsTheBandwidthUnlessEncodersAreNoisy) {
  std::mt19937_64 random(3);
  const Robot robot = SampleRobot("2R planar (vertical plane)");
  Log log = RecordMotion(RandomMultisine(&random, 2), 20, .002);
  log.tau.setOnes(log.size(), 2);  // each joint has a motor
  LinearCalibrationOptions options;
  options.bandwidth_hz = 20;
  const auto window = [&] {
    return MakeRowOptions(options, SetOf(robot, log)).window_s;
  };
  AddNoise(&random, Eigen::VectorXd::Constant(2, 1e-7), &log.q);
  EXPECT_NEAR(PowerAt(20, window()), .5, .001);
  AddNoise(&random, Eigen::VectorXd::Constant(2, 1e-2), &log.q);
  EXPECT_DOUBLE_EQ(window(), .3);
  options.window_s = .12;
  EXPECT_EQ(window(), .12);
}

// At the least 16 samples: 100 Hz with a bandwidth of 20 Hz.
TEST(WeakWindow, HoldsSamplesEnough) {
  std::mt19937_64 random(3);
  const Robot robot = SampleRobot("2R planar (vertical plane)");
  Log log = RecordMotion(RandomMultisine(&random, 2), 20, .01);
  log.tau.setOnes(log.size(), 2);  // each joint has a motor
  EXPECT_NEAR(DefaultWindow(20, SetOf(robot, log)), .16, 1e-12);
}

// Friction of a real drive: it falls off with speed, so that no Coulomb and
// viscous friction fit it, and changes sign within .02 rad/s. A reversal that
// the bandwidth passes is seen by the default as by the differential model.
class FallingFriction : public testing::Test {
 protected:
  FallingFriction() : robot_(SampleRobot("2R planar (vertical plane)")) {
    SetRandomInertials(&random_, &robot_);
    log_ = RecordMotion(RandomMultisine(&random_, 2, 1.5), 20, .002);
    AddTorque(robot_, &log_);
    for (int j = 0; j < 2; ++j) {
      const ArrayXd v = log_.qd.col(j).array();
      log_.tau.col(j).array() += 2 * (v / .02).tanh() + 2 * (v / .6).tanh();
    }
    AddNoise(&random_, Eigen::VectorXd::Constant(2, 1e-6), &log_.q);
    AddNoise(&random_, .005 * ColumnRms(log_.tau), &log_.tau);
    options_.bandwidth_hz = 40;
  }
  LinearCalibration Calibrate(Identification identification) {
    options_.identification = identification;
    return CalibrateLogs(robot_, {log_}, options_);
  }

  std::mt19937_64 random_{11};
  Robot robot_;
  Log log_;
  LinearCalibrationOptions options_;
};

TEST_F(FallingFriction, IsThatOfTheDifferentialModel) {
  const LinearCalibration weak = Calibrate(Identification::kWeak);
  const LinearCalibration differential =
      Calibrate(Identification::kDifferential);
  for (int k = 0; k < weak.parameters.size(); ++k) {
    const ModelParameter& p = weak.parameters.parameters()[k];
    if (!p.is_joint_term || p.term != JointTerm::kCoulomb) continue;
    EXPECT_LT(std::abs(weak.x[k] - differential.x[k]),
              2 * differential.stddev[k])
        << p.name << " " << weak.x[k] << " " << differential.x[k] << " +- "
        << differential.stddev[k];
    const double ratio = weak.transitions[p.block].width /
                         differential.transitions[p.block].width;
    EXPECT_NEAR(ratio, 1, .5) << p.name;
  }
}

}  // namespace armcal::weak_window_test
