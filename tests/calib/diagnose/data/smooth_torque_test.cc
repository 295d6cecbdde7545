#include "calib/diagnose/data/smooth_torque.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace armcal::smooth_torque_test {

using Eigen::MatrixXd;

constexpr double kStep = .01;  // s
constexpr int kSamples = 3000;

double Sine(double hz, int k) { return std::sin(2 * M_PI * hz * k * kStep); }

double Fast(int k) { return 2 * (Sine(4, k) + Sine(5.7, k) + Sine(7, k)); }

// A joint with 20 N m at 1 Hz and 2 N m each at 4, 5.7 and 7 Hz; `noise` N m of
// each sample is what its positions' noise makes.
GapSegment Swing(double noise) {
  GapSegment segment;
  segment.motion.dt = kStep;
  segment.motion.q = segment.motion.qd = segment.motion.qdd =
      MatrixXd::Zero(kSamples, 1);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  segment.tau.resize(kSamples, 1);
  segment.torque_noise.resize(kSamples, 1);
  for (int k = 0; k < kSamples; ++k) {
    segment.tau(k, 0) = 20 * Sine(1, k) + Fast(k) + noise * normal(random);
    segment.torque_noise(k, 0) = noise * normal(random);
  }
  segment.reconstructed_torque = true;
  return segment;
}

TEST(SmoothTorque, OfReconstructedTorquesEndsWhereTheirNoiseBegins) {
  // Each has 2 N m^2; the noise has a thirtieth of its own between 6.5 and 8
  // Hz.
  const SmoothTorque clear = SmoothTorqueOf(Swing(.05));
  EXPECT_GT(clear.hz, 7);
  EXPECT_LT(clear.hz, 13) << "there is nothing but noise above";
  const SmoothTorque noisy = SmoothTorqueOf(Swing(2));
  EXPECT_LT(noisy.hz, 4);
  for (int k = 500; k < 2500; k += 37) {
    const double slow = 20 * Sine(1, k);
    EXPECT_NEAR(clear.tau(k, 0), slow + Fast(k), 1);
    EXPECT_NEAR(noisy.tau(k, 0), slow, 3);
  }
}

// What a loop says that loses its stability is no signal.
TEST(SmoothTorque, DoesNotCountWhatIsLost) {
  GapSegment segment = Swing(.05);
  for (int k = 1000; k < 1500; ++k) segment.tau(k, 0) += 5000 * Sine(19, k);
  segment.lost = {{9, 16}};
  EXPECT_LT(SmoothTorqueOf(segment).hz, 13);
  segment.lost.clear();
  EXPECT_GT(SmoothTorqueOf(segment).hz, 13);
}

TEST(SmoothTorque, OfRecordedTorquesIsSlow) {
  GapSegment segment = Swing(.05);
  segment.reconstructed_torque = false;
  segment.torque_noise.resize(0, 0);
  const SmoothTorque smooth = SmoothTorqueOf(segment);
  EXPECT_EQ(smooth.hz, 3);
  EXPECT_NEAR(smooth.tau(1525, 0), 20 * Sine(1, 1525), 3);
}

}  // namespace armcal::smooth_torque_test
