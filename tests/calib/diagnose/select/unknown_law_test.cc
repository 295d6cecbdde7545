#include "calib/diagnose/select/unknown_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "tests/fixtures/sample_motion.h"

namespace armcal::unknown_law_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kRows = 2000, kShapes = 20;
constexpr double kRoutine = .1, kPlaces = 1000;

// One joint whose noise is 1: what models lack is a few slow waves.
class UnknownLawTest : public testing::Test {
 protected:
  UnknownLawTest() : shapes_(kRows, kShapes), discrepancy_(kShapes) {
    for (int k = 0; k < kShapes; ++k) {
      for (int i = 0; i < kRows; ++i) {
        shapes_(i, k) = kRoutine * std::cos(M_PI * (k + 1) * i / kRows);
      }
    }
    std::iota(discrepancy_.begin(), discrepancy_.end(), 0);
  }
  VectorXd Noise() {
    return VectorXd::NullaryExpr(kRows, [&] { return Normal(&random_); });
  }
  // Of so many times the routine size.
  VectorXd Law(double size) {
    return shapes_ * VectorXd::NullaryExpr(
                         kShapes, [&] { return size * Normal(&random_); });
  }
  static VectorXd Pulse(int at) {
    VectorXd pulse(kRows);
    for (int i = 0; i < kRows; ++i) {
      pulse[i] = std::exp(-std::pow((i - at) / 15., 2));
    }
    return pulse;
  }
  GapScreen Screen(const VectorXd& target) const {
    GapScreen screen(OnEachJoint({shapes_}), kShapes, {target});
    screen.Factor();
    return screen;
  }
  double Odds(const VectorXd& target, double usual_size,
              const std::vector<int>& times) const {
    const GapScreen screen = Screen(target);
    std::vector<JointRows> pulses;
    for (const int at : times) pulses.push_back({10 * Pulse(at)});
    return UnknownLawOdds(screen, discrepancy_, usual_size, pulses,
                          times.size() * std::log(kPlaces), VectorXd::Ones(1));
  }

  MatrixXd shapes_;
  std::vector<int> discrepancy_;
  std::mt19937_64 random_{3};
};

TEST_F(UnknownLawTest, EvidenceTellsTheDiscrepancysSize) {
  for (const double size : {1., 10., 30.}) {
    const GapScreen screen = Screen(Law(size) + Noise());
    EXPECT_EQ(DiscrepancySize(screen, discrepancy_, VectorXd::Ones(1)), size);
  }
}

TEST_F(UnknownLawTest, PulsesAreNoLaw) {
  const VectorXd pushed = 10 * Pulse(500) - 8 * Pulse(900) + Law(1) + Noise();
  EXPECT_LT(Odds(pushed, 1, {500, 900}), -50);
}

// A hold is much longer than a pulse, which leaves its flanks. Of any course
// within its window it is as little of a law as a pulse is.
TEST_F(UnknownLawTest, AHoldIsNoLawWhereItsCourseIsFree) {
  VectorXd hold = VectorXd::Zero(kRows);
  hold.segment(500, 120).setConstant(10);
  std::vector<int> times;
  for (int at = 500; at <= 620; at += 15) times.push_back(at);
  const VectorXd pushed = hold + Law(1) + Noise();
  EXPECT_GT(Odds(pushed, 1, {560}), 0);
  EXPECT_LT(Odds(pushed, 1, times), -50);
}

// Where waves are highest, pulses explain much of them, not the rest.
TEST_F(UnknownLawTest, ALawIsNoPulses) {
  const VectorXd law = Law(30);
  int highest, lowest;
  law.maxCoeff(&highest);
  law.minCoeff(&lowest);
  EXPECT_GT(Odds(law + Noise(), 1, {highest, lowest}), 50);
}

// A model that lacks as much without any push is no reason to deny one.
TEST_F(UnknownLawTest, WhatTheReferenceLacksAsWellSaysNothing) {
  const VectorXd pushed = 10 * Pulse(500) + Law(10) + Noise();
  EXPECT_GT(Odds(pushed, 1, {500}), 0);
  EXPECT_LT(Odds(pushed, 10, {500}), -20);
}

// Noise that looks like a pulse somewhere is none: there are many places.
TEST_F(UnknownLawTest, APulseHasToOutweighItsPlaces) {
  const VectorXd weak = 1.2 * Pulse(500) + Noise();
  const GapScreen screen = Screen(weak);
  const VectorXd noise = VectorXd::Ones(1);
  const double few =
      UnknownLawOdds(screen, discrepancy_, 1, {{Pulse(500)}}, 0, noise);
  const double many = UnknownLawOdds(screen, discrepancy_, 1, {{Pulse(500)}},
                                     std::log(kPlaces), noise);
  EXPECT_NEAR(many - few, 2 * std::log(kPlaces), 1e-9);
}

// Pulses on the second of two joints: back where the first one was, the arm
// felt nothing. Where it never came back nothing is refuted, nor by what is no
// pulse.
TEST(IsLawRefuted, WhereTheArmCameBackAndFeltNothing) {
  std::vector<GapEvent> events(3);
  for (GapEvent& event : events) {
    event.pulse = true;
    event.contact.joint = 1;
  }
  const Returning never = {5, 0, 0}, again = {5, 4.5, 2}, nothing = {5, .2, 1};
  EXPECT_TRUE(IsLawRefuted(events, {nothing, nothing, never}, 1));
  EXPECT_FALSE(IsLawRefuted(events, {nothing, nothing, never}, 0));
  EXPECT_FALSE(IsLawRefuted(events, {nothing, never, never}, 1))
      << "one of three";
  EXPECT_FALSE(IsLawRefuted(events, {again, again, never}, 1));
  EXPECT_FALSE(IsLawRefuted(events, {never, never, never}, 1));
  events[0].pulse = false;
  EXPECT_FALSE(IsLawRefuted(events, {nothing, never, again}, 1));
  EXPECT_FALSE(IsLawRefuted(events, {nothing, nothing, never}, 1))
      << "of the pulses half";
}

}  // namespace armcal::unknown_law_test
