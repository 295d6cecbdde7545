#include "model/dynamics/deflection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "model/dynamics/flanked_spring.h"

namespace armcal::deflection_test {

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

// Of links whose load does not depend on where and how fast the joint moves.
Deflection Follow(const Transmission& law, const VectorXd& load) {
  const VectorXd inertia = VectorXd::Constant(kSamples, kInertia);
  const VectorXd none = VectorXd::Zero(kSamples);
  return FollowDeflections({{&law, load, none, none, inertia}}, kStep)[0];
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

// What the load depends on adds to the gear's own spring and damper, here to
// make the ones of a textbook's vibration; a load that drives the oscillation,
// too. With a law, and with a spring in lanes.
TEST(Deflection, TakesWhatItsLoadDependsOn) {
  const double k = 5000, c = 40;
  const VectorXd t = VectorXd::LinSpaced(kSamples, 0, (kSamples - 1) * kStep);
  const VectorXd load = 10 * (20 * t.array()).sin();
  const VectorXd inertia = VectorXd::Constant(kSamples, kInertia);
  const Deflection expected = Follow(SpringAndDamper(k, c), load);
  for (const double share : {-1., -.2, .4, 1.}) {
    const VectorXd stiffness = VectorXd::Constant(kSamples, share * k / 2);
    const VectorXd damping = VectorXd::Constant(kSamples, share * c / 2);
    const double own_k = (1 - share / 2) * k, own_c = (1 - share / 2) * c;
    std::vector<Transmission> both(2, SpringAndDamper(own_k, own_c));
    both[1].torque = FlankedSpring{0, own_k, own_c};
    for (const Transmission& law : both) {
      const Deflection d = FollowDeflections(
          {{&law, load, stiffness, damping, inertia}}, kStep)[0];
      EXPECT_LT((d.angle - expected.angle).norm(), 1e-4 * expected.angle.norm())
          << share;
      EXPECT_LT((d.rate - expected.rate).norm(), 1e-3 * expected.rate.norm())
          << share;
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

// A load that is dropped leaves a free oscillation, of Duffing's period:
//   4 / sqrt(k / I (1 + s A^2)) K(m),  m = s A^2 / (2 (1 + s A^2)),
// A its amplitude and K the complete elliptic integral of parameter m.
TEST(Deflection, RingsFasterWhereItStiffens) {
  const double k = 2000, load = 20;
  const VectorXd none = VectorXd::Zero(kSamples);
  const VectorXd inertia = VectorXd::Constant(kSamples, kInertia);
  VectorXd dropped = none;
  dropped.head(100).setConstant(load);
  for (const double stiffer : {0., .3, 3.}) {
    Transmission law;
    law.torque = FlankedSpring{0, k, 0, stiffer * std::pow(k / load, 2)};
    const VectorXd d =
        FollowDeflections({{&law, dropped, none, none, inertia}}, kStep)[0]
            .angle;
    const double A = d.head(98).mean(),
                 sA2 = stiffer * std::pow(A * k / load, 2);
    EXPECT_NEAR(A * (1 + sA2), load / k, 1e-6 * load / k);
    const double m = sA2 / (2 * (1 + sA2));
    const double period = 4 / std::sqrt(k / kInertia * (1 + sA2)) *
                          std::comp_ellint_1(std::sqrt(m));
    // Rising through zero, the first time and the last.
    std::vector<double> crossings;
    for (int i = 100; i + 1 < kSamples; ++i) {
      if (d[i] < 0 && d[i + 1] >= 0) {
        crossings.push_back((i - d[i] / (d[i + 1] - d[i])) * kStep);
      }
    }
    ASSERT_GT(crossings.size(), 15u);
    EXPECT_NEAR((crossings.back() - crossings.front()) / (crossings.size() - 1),
                period, .005 * period)
        << stiffer;
  }
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

// Flanks 20 mrad apart, of 1000 N m/rad and 50 N m s/rad: by hand.
TEST(FlankedSpring, PressesAndNeverPulls) {
  const FlankedSpring flanks{.02, 1000, 50};
  EXPECT_NEAR(flanks(.012, 0), 2, 1e-12);
  EXPECT_NEAR(flanks(-.012, 0), -2, 1e-12);
  EXPECT_NEAR(flanks(.012, .1), 7, 1e-12);
  EXPECT_NEAR(flanks(-.012, -.1), -7, 1e-12);
  EXPECT_EQ(flanks(.009, 1), 0);
  EXPECT_EQ(flanks(-.009, -1), 0);
  // Parting faster than the flank follows.
  EXPECT_EQ(flanks(.012, -1), 0);
  EXPECT_EQ(flanks(-.012, 1), 0);
  // In the middle of a corner, a quarter of its half width.
  EXPECT_NEAR(flanks(.01, 0), 1000 * .25 * .005 * .02, 1e-12);
}

// Springs, with gaps and without, of joints that carry different loads: in
// lanes they go as the law does when nobody knows it, step by step with
// differences for its slopes; and together as alone, to the bit.
TEST(Deflection, SpringsInLanesGoAsTheirLaws) {
  const VectorXd t = VectorXd::LinSpaced(kSamples, 0, (kSamples - 1) * kStep);
  std::vector<VectorXd> loads, stiffnesses, dampings, inertias;
  std::vector<Transmission> springs, laws;
  for (int i = 0; i < 11; ++i) {
    loads.push_back(20 * ((3. + i) * t.array()).sin() + i);
    inertias.push_back(1.5 + .5 * ((2. + i) * t.array()).cos());
    stiffnesses.push_back(60 * ((4. - i) * t.array()).cos());
    dampings.push_back(1.5 * ((2. + i) * t.array()).sin());
    const double k = 2000 * (1 + i * i);
    FlankedSpring spring{i % 3 == 0 ? 0 : .002 * i, k, .3 * std::sqrt(k)};
    // By 60 % at the load.
    if (i % 6 == 3) spring.stiffening = .6 * std::pow(k / 20, 2);
    springs.emplace_back();
    springs.back().torque = spring;
    springs.back().stiffest = k;
    springs.back().initial_deflection = [=](double load) { return load / k; };
    laws.push_back(springs.back());
    laws.back().torque = [spring](double d, double rate, const double*,
                                  double*) { return spring(d, rate); };
  }
  std::vector<DeflectedJoint> all;
  for (int i = 0; i < 11; ++i) {
    all.push_back(
        {&springs[i], loads[i], stiffnesses[i], dampings[i], inertias[i]});
  }
  const std::vector<Deflection> together = FollowDeflections(all, kStep);
  for (int i = 0; i < 11; ++i) {
    const Deflection alone = FollowDeflections({all[i]}, kStep)[0];
    EXPECT_EQ(alone.angle, together[i].angle) << i;
    EXPECT_EQ(alone.acceleration, together[i].acceleration) << i;
    DeflectedJoint unknown = all[i];
    unknown.transmission = &laws[i];
    const Deflection law = FollowDeflections({unknown}, kStep)[0];
    EXPECT_LT((alone.angle - law.angle).norm(), 1e-6 * law.angle.norm()) << i;
    EXPECT_LT((alone.rate - law.rate).norm(), 1e-5 * law.rate.norm()) << i;
    EXPECT_LT((alone.acceleration - law.acceleration).norm(),
              1e-5 * law.acceleration.norm())
        << i;
  }
}

}  // namespace armcal::deflection_test
