#include "model/dynamics/joint_warmth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace armcal::joint_warmth_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStep = .05;  // s
constexpr int kSamples = 1200;

// 4 W for 20 s, then nothing, of a joint of 3 J/K and 5 K/W: in closed form.
struct WarmedJoint {
  WarmedJoint() : power(kSamples), warmth(kSamples) {
    const double end = 20, T = 15;
    for (int k = 0; k < kSamples; ++k) {
      const double t = k * kStep;
      power[k] = t <= end ? 4 : 0;
      warmth[k] = t <= end
                      ? -20 * std::expm1(-t / T)
                      : -20 * std::expm1(-end / T) * std::exp(-(t - end) / T);
    }
  }
  VectorXd power, warmth;
};

// Nothing is lost to the surroundings: 3 T' = P exp(-b T) gives
// T = log(1 + b P t / 3) / b, of viscous and of Coulomb friction alike.
TEST(JointWarmth, FrictionThatFallsHeatsTheLess) {
  const double b = .05, P = 4;
  const MatrixXd power = MatrixXd::Constant(kSamples, 2, P);
  MatrixXd viscous = power, coulomb = power;
  viscous.col(1).setZero();
  coulomb.col(0).setZero();
  const MatrixXd warmth = JointWarmth({viscous, coulomb}, kStep,
                                      {{3, 1e9, b, .9}, {3, 1e9, .9, b}});
  for (int k = 0; k < kSamples; ++k) {
    const double T = std::log1p(b * P * k * kStep / 3) / b;
    ASSERT_NEAR(warmth(0, k), T, .002 * T) << k;
    ASSERT_NEAR(warmth(1, k), T, .002 * T) << k;
  }
}

TEST(FitThermal, FindsCapacityAndResistance) {
  const WarmedJoint joint;
  const JointThermal fitted = FitThermal(joint.power, joint.warmth, kStep);
  EXPECT_NEAR(fitted.capacity * fitted.resistance, 15, .1 * 15);
  EXPECT_NEAR(fitted.resistance, 5, .1 * 5);
}

TEST(FitThermal, ZeroAndNoiseOfTheThermometerDoNotMatter) {
  WarmedJoint joint;
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, .3);
  for (double& T : joint.warmth) T += 25 + noise(random);
  EXPECT_NEAR(FitThermal(joint.power, joint.warmth, kStep).resistance, 5, .5);
}

// A joint that cools while it works tells nothing of itself.
TEST(FitThermal, WarmthFromElsewhereGivesTheUsualJoint) {
  const WarmedJoint joint;
  const JointThermal fitted = FitThermal(joint.power, -joint.warmth, kStep);
  EXPECT_EQ(fitted.capacity, JointThermal().capacity);
  EXPECT_EQ(fitted.resistance, JointThermal().resistance);
}

}  // namespace armcal::joint_warmth_test
