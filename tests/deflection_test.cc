#include "model/deflection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr int kSamples = 1000;
constexpr double kStep = .005, kInertia = 2;  // s, kg m^2

Transmission SpringAndDamper(double k, double c) {
  Transmission law;
  law.torque = [=](double d, double rate, const double*, double*) {
    return k * d + c * rate;
  };
  return law;
}

Deflection Follow(const Transmission& law, const VectorXd& load) {
  return FollowDeflection(law, load, VectorXd::Constant(kSamples, kInertia),
                          kStep);
}

// Forced vibration of one mass: the textbook's amplitude and phase, long after
// the start; below and near its resonance at 50 rad/s.
TEST(Deflection, IsTheForcedVibrationOfTheLink) {
  using Complex = std::complex<double>;
  const double k = 5000, c = 40;
  for (const double omega : {5., 20., 45.}) {
    const VectorXd t = VectorXd::LinSpaced(kSamples, 0, (kSamples - 1) * kStep);
    const Deflection d =
        Follow(SpringAndDamper(k, c), 10 * (omega * t.array()).sin());
    const Complex amplitude =
        10. / Complex(k - kInertia * omega * omega, c * omega);
    for (int i = kSamples / 2; i + 1 < kSamples; ++i) {
      const Complex wave = amplitude * std::polar(1., omega * t[i]);
      const double size = std::abs(amplitude);
      EXPECT_NEAR(d.angle[i], wave.imag(), .02 * size);
      EXPECT_NEAR(d.rate[i], omega * wave.real(), .02 * omega * size);
      EXPECT_NEAR(d.acceleration[i], -omega * omega * wave.imag(),
                  .03 * omega * omega * size);
    }
  }
}

// A spring of 1e9 N m/rad, in steps far beyond its period, is the static one.
TEST(Deflection, OfAStiffGearIsStatic) {
  const VectorXd t = VectorXd::LinSpaced(kSamples, 0, (kSamples - 1) * kStep);
  const VectorXd load = 10 + (6 * t.array()).sin();
  const Deflection d = Follow(SpringAndDamper(1e9, 1e3), load);
  EXPECT_LT((d.angle - load / 1e9).cwiseAbs().maxCoeff(), 2e-11);
}

// A log that begins in motion does not shake what it finds, but for the damper,
// which rest leaves out: c omega / k = 4 % of the rate.
TEST(Deflection, BeginsQuietly) {
  const double k = 5000, slope = 50;  // N m/rad, N m/s
  const VectorXd load =
      VectorXd::LinSpaced(kSamples, 10, 10 + slope * (kSamples - 1) * kStep);
  const Deflection d = Follow(SpringAndDamper(k, 4), load);
  EXPECT_LT((d.rate.array() - slope / k).abs().maxCoeff(), .05 * slope / k);
}

// Free flight across a gap: with the load F from the flank, F / M t^2 / 2.
TEST(Deflection, CrossesAGapInFreeFlight) {
  Transmission law;
  const double gap = .02, k = 1e5;
  law.torque = [=](double d, double rate, const double*, double*) {
    if (std::abs(d) < gap / 2) return 0.;
    return k * (d - std::copysign(gap / 2, d)) + 900 * rate;
  };
  law.stiffest = k;
  // At -10 N m it rests on one flank, at +4 N m it leaves it.
  VectorXd load = VectorXd::Constant(kSamples, -10);
  const int leaves = 100;
  load.tail(kSamples - leaves).setConstant(4);
  const Deflection d = Follow(law, load);
  EXPECT_NEAR(d.angle[leaves - 2], -gap / 2 - 10 / k, 1e-8);
  // The cubic through the samples turns half a sample earlier.
  const double crossing = std::sqrt(2 * gap * kInertia / 4);
  int arrives = leaves;
  while (d.angle[arrives] < gap / 2) ++arrives;
  EXPECT_NEAR((arrives - leaves) * kStep, crossing, 2 * kStep);
  EXPECT_NEAR(d.angle[kSamples - 1], gap / 2 + 4 / k, 1e-8);
  // What the flank gives stops the link, whatever falls between samples.
  EXPECT_NEAR(d.acceleration.sum() * kStep, 0, 1e-9);
}

}  // namespace
}  // namespace armcal
