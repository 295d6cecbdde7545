#include "calib/diagnose/select/growth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "calib/diagnose/select/fit.h"
#include "model/effects/effects.h"
#include "model/signals/delayed_signal.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::growth_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBandwidth = 6;  // Hz

// An arm of which each joint's torque but the first's is off by three standard
// deviations of its white noise, and the first's by 40 of one that hardly
// changes from sample to sample, so that few of its rows are independent.
class GrowthTest : public testing::Test {
 protected:
  GrowthTest()
      : arm_("PUMA560 6R", 30, .01),
        baseline_(arm_.robot, {}, VectorXd::Constant(6, 10)) {}

  MatrixXd Torque() {
    MatrixXd tau =
        RecordedTorque(arm_.robot, baseline_.transitions(), arm_.motion)
            .nominal();
    constexpr double kKept = .995;
    VectorXd last = VectorXd::Zero(6);
    for (Eigen::Index k = 0; k < tau.rows(); ++k) {
      for (int j = 0; j < 6; ++j) {
        const double kept = j == 0 ? kKept : 0;
        last[j] =
            kept * last[j] + std::sqrt(1 - kept * kept) * .5 * Normal(&random_);
        tau(k, j) += last[j] + (j == 0 ? 20 : 1.5);
      }
    }
    return tau;
  }

  EffectArm arm_;
  GapBaseline baseline_;
  std::mt19937_64 random_{11};
};

TEST_F(GrowthTest, WhatIsMostOfTheGapIsAmongTheFewThatAreChosen) {
  GapFitOptions options;
  options.bandwidth_hz = kBandwidth;
  GapFit fit(baseline_, options, {MakeSegment(arm_.motion, Torque())}, {});
  fit.Choose();
  const std::vector<GapCandidate>& effects = fit.refined().effects;
  ASSERT_FALSE(effects.empty());
  const auto is_it = [](const GapCandidate& effect) {
    return effect.joint == 0 && effect.effect->name == "torque_offset";
  };
  EXPECT_EQ(std::count_if(effects.begin(), effects.end(), is_it), 1);
}

void SetFriction(double viscous, double coulomb, Robot* robot) {
  for (Link& link : robot->links) {
    link.joint.viscous = viscous;
    link.joint.coulomb = coulomb;
  }
}

// Friction of all joints that turns over a milliradian instead of at once,
// which all of them show as torque that comes 17 ms late.
class FrictionThatLagsTest : public testing::Test {
 protected:
  FrictionThatLagsTest() : arm_("PUMA560 6R", 30, .005) {
    SetFriction(1, 4, &arm_.robot);
    arm_.SetScale();
    baseline_.emplace(arm_.robot, BaselineOptions{}, VectorXd::Constant(6, 10));
  }

  // What is chosen where so much of the friction lags, and torque by so much.
  std::set<std::string> ChosenOf(double share, double late) {
    SimulatedRobot robot;
    robot.robot = arm_.robot;
    for (int j = 0; j < 6; ++j) {
      robot.robot.links[j].joint.coulomb *= 1 - share;
      const EffectSite site = {&arm_.robot, j, &arm_.scale};
      FindEffect("presliding")
          ->apply(site, Eigen::Vector2d(4 * share, .001), &robot);
    }
    robot.torque_delay = late;
    RecordedTorque recorded(arm_.robot, baseline_->transitions(), arm_.motion);
    return ChosenOf(recorded.nominal() + recorded.Change(robot));
  }
  std::set<std::string> ChosenOf(MatrixXd tau) {
    AddNoise(&random_, VectorXd::Constant(6, 1), &tau);
    GapFitOptions options;
    options.bandwidth_hz = kBandwidth;
    GapFit fit(*baseline_, options, {MakeSegment(arm_.motion, tau)}, {});
    fit.Choose();
    std::set<std::string> chosen;
    for (const GapCandidate& effect : fit.refined().effects) {
      chosen.insert(effect.effect->name);
    }
    return chosen;
  }

  EffectArm arm_;
  std::optional<GapBaseline> baseline_;
  std::mt19937_64 random_{7};
};

TEST_F(FrictionThatLagsTest, IsNoDelay) {
  const std::set<std::string> chosen = ChosenOf(1, 0);
  EXPECT_EQ(chosen.count("presliding"), 1u);
  EXPECT_EQ(chosen.count("delay"), 0u);
}

// Coulomb friction of all joints that changes sign 15 ms before the recorded
// velocity does, with the rest of the torque in time: friction that a simulator
// keeps smooth leads by some 10 ms.
TEST_F(FrictionThatLagsTest, OfItsOwnTimeIsNoDelay) {
  Robot smooth = arm_.robot;
  for (Link& link : smooth.links) link.joint.coulomb = 0;
  const auto torque_of = [&](const Robot& robot) {
    return RecordedTorque(robot, baseline_->transitions(), arm_.motion)
        .nominal();
  };
  const MatrixXd without = torque_of(smooth);
  const std::set<std::string> chosen =
      ChosenOf(without + Delayed(torque_of(arm_.robot) - without,
                                 -.015 / arm_.motion.dt));
  EXPECT_EQ(chosen.count("delay"), 0u);
}

// Friction changes sign at another time than the delay's, and inertia and
// gravity at the delay's.
TEST_F(FrictionThatLagsTest, ADelayBesideItIsOne) {
  for (const double late : {.01, .02}) {
    EXPECT_EQ(ChosenOf(1, late).count("delay"), 1u) << late;
  }
}

TEST_F(FrictionThatLagsTest, ADelayIsOne) {
  EXPECT_THAT(ChosenOf(0, .02), testing::ElementsAre("delay"));
}

}  // namespace armcal::growth_test
