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

#include "calib/diagnose/data/days.h"
#include "calib/diagnose/data/thresholds.h"
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

// Torques of another day, of which each joint's is off by a small part of the
// friction, with white noise, and joint 1's by as much more.
class ZerosOfAnotherDayTest : public testing::Test {
 protected:
  ZerosOfAnotherDayTest() : arm_("PUMA560 6R", 20, .01) {
    SetFriction(3, 4, &arm_.robot);
    baseline_.emplace(arm_.robot, BaselineOptions{}, VectorXd::Constant(6, 10));
    baseline_->FreeDays();
  }

  GapSegment Recorded(int log, const VectorXd& zeros) {
    MatrixXd tau =
        RecordedTorque(arm_.robot, baseline_->transitions(), arm_.motion)
            .nominal();
    AddNoise(&random_, VectorXd::Constant(6, .1), &tau);
    tau.rowwise() += zeros.transpose();
    GapSegment segment = MakeSegment(arm_.motion, tau);
    segment.log = log;
    return segment;
  }
  GapFit Fit(const VectorXd& zeros) {
    GapFitOptions options;
    options.bandwidth_hz = kBandwidth;
    GapFit fit(*baseline_, options, {Recorded(0, zeros)},
               {Recorded(1, VectorXd::Zero(6))});
    fit.Choose();
    return fit;
  }
  static std::vector<std::string> PlacesOf(const GapFit& fit) {
    std::vector<std::string> places;
    for (const GapCandidate& effect : fit.refined().effects) {
      places.push_back(effect.place());
    }
    return places;
  }

  EffectArm arm_;
  std::optional<GapBaseline> baseline_;
  std::mt19937_64 random_{5};
  const VectorXd small_ =
      (VectorXd(6) << .15, -.2, .1, -.25, .2, -.15).finished();
};

// A spring of 20 N m/rad on the second joint, which the diagnosed log has.
TEST_F(ZerosOfAnotherDayTest, WhatAReferenceHasAsWellIsToldBefore) {
  constexpr double kStiffness = 20;
  GapCandidate spring;
  spring.effect = FindEffect("spring");
  spring.joint = 1;
  spring.p = Eigen::Vector2d(kStiffness, 0);
  const auto odds = [&](double in_reference) {
    GapSegment log = Recorded(0, VectorXd::Zero(6));
    log.tau.col(1) += kStiffness * arm_.motion.q.col(1);
    GapSegment reference = Recorded(1, VectorXd::Zero(6));
    reference.tau.col(1) += in_reference * arm_.motion.q.col(1);
    const GapRegression regression(*baseline_, kBandwidth, {log}, {reference});
    return regression.ShareInReference(spring, regression.TorqueOf({spring}))
        .odds();
  };
  EXPECT_GT(odds(kStiffness), Limits().score);
  EXPECT_LT(odds(.3 * kStiffness), 0);
  EXPECT_LT(odds(0), -100);
}

// A load that the diagnosed log alone has. Numbers of the reference's own could
// make up for one there; those that the log has as well, given it, cannot.
TEST_F(ZerosOfAnotherDayTest, AReferenceHasNoMoreThanBothLogsNumbersSay) {
  GapCandidate load;
  load.effect = FindEffect("payload");
  load.p =
      VectorXd::Zero(static_cast<Eigen::Index>(load.effect->parameters.size()));
  load.p[0] = .5;
  SimulatedRobot loaded;
  loaded.robot = arm_.robot;
  load.effect->apply({&arm_.robot, -1, &arm_.scale}, load.p, &loaded);
  GapSegment log = Recorded(0, VectorXd::Zero(6));
  log.tau += RecordedTorque(arm_.robot, baseline_->transitions(), arm_.motion)
                 .Change(loaded);
  const GapRegression regression(*baseline_, kBandwidth, {log},
                                 {Recorded(1, VectorXd::Zero(6))});
  EXPECT_LT(
      regression.ShareInReference(load, regression.TorqueOf({load})).odds(),
      -100);
}

TEST_F(ZerosOfAnotherDayTest, AreNoEffects) {
  const GapFit fit = Fit(small_);
  EXPECT_THAT(PlacesOf(fit), testing::IsEmpty());
  EXPECT_FALSE(fit.regression().HoldsZeros());
  for (const int c : ZeroColumns(*baseline_)) {
    const BaselineColumn& column = baseline_->columns()[c];
    EXPECT_NEAR(fit.refined().baseline[c] * column.spread, small_[column.joint],
                .05);
  }
}

TEST_F(ZerosOfAnotherDayTest, OneThatIsFarBeyondTheOthersIs) {
  VectorXd zeros = small_;
  zeros[2] = 8;
  const GapFit fit = Fit(zeros);
  ASSERT_THAT(PlacesOf(fit), testing::ElementsAre("torque_offset@3"));
  EXPECT_NEAR(fit.refined().effects[0].p[0], 8, .1);
  EXPECT_FALSE(fit.regression().HoldsZeros());
}

// In a motion this small a load is a torque on each joint that hardly changes:
// with an offset on the first joint all of it looks like zeros that moved, and
// by more than the load explains alone. Both together are simpler.
TEST_F(ZerosOfAnotherDayTest, AreNoLoadAndAnotherEffect) {
  constexpr double kScale = .02;
  Motion& motion = arm_.motion;
  const Eigen::RowVectorXd about = motion.q.row(0);
  motion.q = kScale * (motion.q.rowwise() - about);
  motion.q.rowwise() += about;
  motion.qd *= kScale;
  motion.qdd *= kScale;
  SimulatedRobot loaded;
  loaded.robot = arm_.robot;
  const Effect& payload = *FindEffect("payload");
  VectorXd p =
      VectorXd::Zero(static_cast<Eigen::Index>(payload.parameters.size()));
  p[0] = .3;
  payload.apply({&arm_.robot, -1, &arm_.scale}, p, &loaded);
  VectorXd zeros = VectorXd::Zero(6);
  zeros[0] = .5;
  GapSegment log = Recorded(0, zeros);
  log.tau += RecordedTorque(arm_.robot, baseline_->transitions(), motion)
                 .Change(loaded);
  GapFitOptions options;
  options.bandwidth_hz = kBandwidth;
  GapFit fit(*baseline_, options, {log}, {Recorded(1, VectorXd::Zero(6))});
  fit.Choose();
  // It weighs on the wrist as a mass on the link before would.
  EXPECT_THAT(PlacesOf(fit), testing::UnorderedElementsAre(
                                 testing::AnyOf("payload", "added_mass@5"),
                                 "torque_offset@1"));
  EXPECT_TRUE(fit.regression().HoldsZeros());
}

TEST_F(ZerosOfAnotherDayTest, TwoOffsetsAreTwoEffects) {
  VectorXd zeros = VectorXd::Zero(6);
  zeros[1] = .8;
  zeros[4] = -.5;
  const GapFit fit = Fit(zeros);
  EXPECT_THAT(PlacesOf(fit), testing::UnorderedElementsAre("torque_offset@2",
                                                           "torque_offset@5"));
  EXPECT_TRUE(fit.regression().HoldsZeros());
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
