#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "tests/model/plant/hidden/hidden_plant.h"

namespace armcal::signals_test {

using Eigen::VectorXd;

Reading Read(const HiddenPlant& plant) {
  Reading reading{plant.at.position, plant.at.velocity, VectorXd::Zero(6),
                  VectorXd::Zero(6)};
  plant.robot.sensors[0].apply(plant.at, &reading);
  return reading;
}

TEST(HiddenSensors, ByHand) {
  HiddenPlant offset("encoder_offset", 2, {-.02});
  offset.at.position[2] = 1;
  EXPECT_EQ(Read(offset).position[2], .98);
  EXPECT_EQ(Read(offset).position[1], 0);
  HiddenPlant disc("encoder_eccentricity", 2, {.01, M_PI / 2});
  EXPECT_EQ(Read(disc).position[2], 0);
  disc.at.position[2] = M_PI;
  EXPECT_NEAR(Read(disc).position[2] - M_PI, -.02, 1e-12);
  disc.at.position[2] = 2 * M_PI;
  EXPECT_NEAR(Read(disc).position[2] - 2 * M_PI, 0, 1e-12);
  HiddenPlant old("aging_tachometer", 2, {.2});
  old.at.velocity[2] = 3;
  EXPECT_EQ(Read(old).velocity[2], 3);
  old.at.t = 20;  // half the time scale: 1 - 1/e of the loss
  EXPECT_NEAR(Read(old).velocity[2], 3 * (1 - .2 * (1 - std::exp(-1))), 1e-12);
  EXPECT_EQ(Read(old).position[2], 0);
}

TEST(HiddenSensors, EncoderWandersByItsSize) {
  HiddenPlant plant("wandering_encoder", 2, {.002});
  double square = 0, step = 0, last = 0;
  for (int k = 0; k < 40000; ++k) {
    plant.at.t = .01 * k;
    const double error = Read(plant).position[2];
    square += error * error / 40000;
    if (k > 0) step = std::max(step, std::abs(error - last));
    last = error;
  }
  EXPECT_NEAR(std::sqrt(square), .002, .0002);
  // No jumps: 16 sines of at most 0.5 Hz.
  EXPECT_LT(step, .01 * .002 * std::sqrt(2 * 16.) * M_PI);
}

TEST(HiddenSensors, ClockRunsFastOnAverage) {
  const HiddenPlant plant("time_base", -1, {.01});
  EXPECT_EQ(plant.robot.clock(0), 0);
  EXPECT_NEAR(plant.robot.clock(15), 15.15, 1e-9);
  double least = 1;
  for (double t = 0; t < 30; t += .1) {
    least = std::min(least, plant.robot.clock(t + .1) - plant.robot.clock(t));
  }
  EXPECT_NEAR(least, .1 * 1.007, 1e-5);  // 0.7 of the rate, and never back
}

TEST(HiddenTimeTorques, ByHand) {
  HiddenPlant drift("time_drift", 0, {.05});
  EXPECT_EQ(drift.Torque(), 0);
  drift.at.t = 40;
  EXPECT_NEAR(drift.Torque(), -.5, 1e-12);
  drift.at.t = 40. / 3;  // half of it after a third of the log
  EXPECT_NEAR(drift.Torque(), -.25, 1e-12);
}

TEST(HiddenTimeTorques, VibrationHasOneLine) {
  HiddenPlant plant("vibration", 0, {.05, 7});
  const auto line = [&plant](double f) {
    std::complex<double> sum = 0;
    for (int k = 0; k < 10000; ++k) {
      plant.at.t = .001 * k;
      sum += plant.Torque() * std::polar(2e-4, -2 * M_PI * f * plant.at.t);
    }
    return std::abs(sum);
  };
  EXPECT_GT(line(7), .8 * .5);
  EXPECT_LT(line(6), .1 * .5);
  EXPECT_LT(line(9), .1 * .5);
}

// The same seed gives the same torque, another another; so do other joints.
TEST(HiddenTimeTorques, RandomTorqueIsItsSeeds) {
  const auto signal = [](std::uint64_t seed, int joint) {
    HiddenPlant plant;
    plant.context.seed = seed;
    plant.Add("random_torque", joint, {.1});
    VectorXd torque(2000);
    for (int k = 0; k < 2000; ++k) {
      plant.at.t = .05 * k;
      torque[k] = plant.Torque();
    }
    return torque;
  };
  const VectorXd a = signal(7, 0);
  EXPECT_EQ((a - signal(7, 0)).norm(), 0);
  EXPECT_NEAR(a.norm() / std::sqrt(2000.), 1, .1);
  for (const VectorXd& b : {signal(8, 0), signal(7, 1)}) {
    EXPECT_LT(std::abs(a.dot(b)) / (a.norm() * b.norm()), .3);
  }
}

TEST(HiddenTimeTorques, BrakeDragsForItsShareOfTheTime) {
  HiddenPlant plant("dragging_brake", 0, {.1, .2});
  plant.at.velocity[0] = 1;
  double sum = 0;
  int free = 0, full = 0;
  for (int k = 0; k < 4000; ++k) {
    plant.at.t = .01 * k;
    const double drag = -plant.Torque();
    sum += drag / 4000;
    free += drag < .01;
    full += drag > .99;
  }
  EXPECT_NEAR(sum, .2, .005);
  EXPECT_GT(free, .75 * 4000);
  EXPECT_GT(full, .15 * 4000);
}

}  // namespace armcal::signals_test
