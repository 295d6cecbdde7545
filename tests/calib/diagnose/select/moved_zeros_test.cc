// Zeros of torques that have moved since a reference, and what looks so.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "calib/diagnose/data/days.h"
#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/select/fit.h"
#include "calib/diagnose/select/growth.h"
#include "model/effects/effects.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::moved_zeros_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBandwidth = 6;  // Hz

// Torques of another day, of which each joint's is off by a small part of the
// friction, with white noise, and joint 1's by as much more.
class ZerosOfAnotherDayTest : public testing::Test {
 protected:
  ZerosOfAnotherDayTest() : arm_("PUMA560 6R", 20, .01) {
    for (Link& link : arm_.robot.links) {
      link.joint.viscous = 3;
      link.joint.coulomb = 4;
    }
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
class LoadInASmallMotionTest : public ZerosOfAnotherDayTest {
 protected:
  LoadInASmallMotionTest() {
    constexpr double kScale = .02;
    Motion& motion = arm_.motion;
    const Eigen::RowVectorXd about = motion.q.row(0);
    motion.q = kScale * (motion.q.rowwise() - about);
    motion.q.rowwise() += about;
    motion.qd *= kScale;
    motion.qdd *= kScale;
  }
  // With viscous friction of these joints, too, N m s/rad.
  GapSegment Loaded(const std::vector<std::pair<int, double>>& viscous) {
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
    log.tau += RecordedTorque(arm_.robot, baseline_->transitions(), arm_.motion)
                   .Change(loaded);
    for (const auto& [joint, size] : viscous) {
      log.tau.col(joint) += size * arm_.motion.qd.col(joint);
    }
    return log;
  }
  std::vector<GapSegment> Reference() {
    return {Recorded(1, VectorXd::Zero(6))};
  }
};

TEST_F(LoadInASmallMotionTest, BesideAnOffsetIsNoZerosThatMoved) {
  GapFitOptions options;
  options.bandwidth_hz = kBandwidth;
  GapFit fit(*baseline_, options, {Loaded({})}, Reference());
  fit.Choose();
  // It weighs on the wrist as a mass on the link before would.
  EXPECT_THAT(PlacesOf(fit), testing::UnorderedElementsAre(
                                 testing::AnyOf("payload", "added_mass@5"),
                                 "torque_offset@1"));
  EXPECT_TRUE(fit.regression().HoldsZeros());
}

// Zeros have one effect each, and what they leave has others: they are no
// likelier for explaining more than as many effects as a selection may have.
TEST_F(LoadInASmallMotionTest, BesideMoreEffectsThanAreChosenIsNone) {
  GapRegression regression(*baseline_, kBandwidth, {Loaded({{2, 40}, {3, 40}})},
                           Reference());
  regression.Refit();
  CandidatePool pool(&regression, {});
  pool.List();
  EXPECT_FALSE(GrowEffects(pool.candidates(), SelectionOptions(), &regression)
                   .other_zeros);
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

}  // namespace armcal::moved_zeros_test
