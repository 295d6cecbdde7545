#include "model/dynamics/drive_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace armcal::drive_law_test {

constexpr double kInertia = 2;    // kg m^2
constexpr double kPeriod = 1e-5;  // s

struct State {
  double q = 0, v = 0, integral = 0;
};

// An inertia alone, whose torque holds for a period.
DriveOutput Step(const DriveLaw& law, double q_ref, State* x) {
  const DriveOutput out = Drive(law, {q_ref, 0, 0, x->q, x->v}, x->integral);
  const double a = out.torque / kInertia;
  x->q += x->v * kPeriod + a * kPeriod * kPeriod / 2;
  x->v += a * kPeriod;
  x->integral += out.integral_rate * kPeriod;
  return out;
}

// Poles at -1, -5, -10: kd / J is their sum; kd kc + ki the sum of products of
// pairs and ki kc the product, both times J, give kc from a quadratic.
DriveLaw Cascade() {
  DriveLaw law;
  law.kd = 16 * kInertia;
  law.position_gain = (65 - std::sqrt(1025.0)) / 32;
  law.velocity_ki = 50 * kInertia / law.position_gain;
  law.velocity_feedforward = 0;
  return law;
}

// The step response by partial fractions of N(s) / (s D(s)).
double StepResponse(const DriveLaw& law, double t) {
  double q = 1;
  const std::vector<double> poles = {-1, -5, -10};
  for (const double p : poles) {
    double slope = kInertia;
    for (const double other : poles) {
      if (other != p) slope *= p - other;
    }
    const double numerator = law.position_gain * (law.kd * p + law.velocity_ki);
    q += numerator / (p * slope) * std::exp(p * t);
  }
  return q;
}

TEST(Drive, CascadeStepsAsItsPolesSay) {
  const DriveLaw law = Cascade();
  State x;
  for (int k = 0; k <= 200000; ++k) {
    if (k % 10000 == 0) {
      EXPECT_NEAR(x.q, StepResponse(law, k * kPeriod), 1e-4) << k;
    }
    Step(law, 1, &x);
  }
}

// On a long way it goes at its limit, and it does not run past the end.
TEST(Drive, CascadeGoesAtItsVelocityLimit) {
  DriveLaw law = Cascade();
  law.velocity_limit = .5;
  State x;
  double fastest = 0, farthest = 0;
  for (int k = 0; k < 3000000; ++k) {
    const DriveOutput out = Step(law, 10, &x);
    fastest = std::max(fastest, x.v);
    farthest = std::max(farthest, x.q);
    if (k == 1000000) {
      EXPECT_TRUE(out.velocity_limited);
      EXPECT_NEAR(x.v, .5, 1e-6);
    }
  }
  EXPECT_NEAR(x.q, 10, 1e-3);
  EXPECT_LT(fastest, .75);
  EXPECT_LT(farthest, 10.05);
}

// The position error of a proportional drive under a load, its own damping
// against the motion, and nothing against the reference's.
TEST(Drive, ProportionalDriveYieldsAndBrakes) {
  DriveLaw law;
  law.kp = 40;
  law.kd = 3;
  law.velocity_feedforward = 0;
  EXPECT_DOUBLE_EQ(Drive(law, {.5, 7, 0, .25, .1}, 0).torque,
                   40 * .25 - 3 * .1);
  law.velocity_feedforward = 1;
  EXPECT_DOUBLE_EQ(Drive(law, {.5, 7, 0, .25, .1}, 0).torque,
                   40 * .25 + 3 * (7 - .1));
}

TEST(Drive, IntegralOfTheVelocityLoopStopsAtTheLimit) {
  DriveLaw law = Cascade();
  law.torque_limit = 3;
  DriveOutput out = Drive(law, {100, 0, 0, 0, 0}, 1);
  EXPECT_EQ(out.torque, 3);
  EXPECT_TRUE(out.torque_limited);
  EXPECT_EQ(out.integral_rate, 0);
  // At the limit, but pulled back from it.
  out = Drive(law, {-.1, 0, 0, 0, 0}, 50);
  EXPECT_EQ(out.torque, 3);
  EXPECT_DOUBLE_EQ(out.integral_rate,
                   -.1 * law.position_gain * law.velocity_ki);
}

}  // namespace armcal::drive_law_test
