#include "calib/inspect/reading_confirmation.h"

#include <gtest/gtest.h>

#include "calib/inspect/log_reading.h"
#include "tests/fixtures/inspected_arm.h"

namespace armcal::reading_confirmation_test {

using Kind = ReadingChange::Kind;

// The second encoder and motor see half of the first joint's angle, too, as
// coupled drives do, and the model does not know: both joints look late,
// and a shift of the torques takes a sixth of the squares that are left.
TEST(ReadingConfirmation, WhatTheModelLacksIsNoDelay) {
  const InspectedArm arm("2R planar (vertical plane)");
  std::mt19937_64 random(7);
  Log log = RecordMotion(RandomMultisine(&random, 2), 8, .01);
  AddTorque(arm.robot, &log);
  for (int j = 0; j < 2; ++j) {
    AddCoulomb(j, 2, {CoulombTransition::Law::kVelocity, .02}, &log);
  }
  AddNoise(&random, .01 * ColumnRms(log.tau), &log.tau);
  log.q.col(1) += .5 * log.q.col(0);
  log.tau.col(0) -= .5 * log.tau.col(1);
  const ReadingFinding found =
      FindReading(arm.robot, UniformSeries(log, .01, .05, 8));
  EXPECT_TRUE(found.changes.empty());
  EXPECT_EQ(found.reading.delay, 0);
}

// Two joints that agree, where all torques are late.
TEST(ReadingConfirmation, LateTorquesOfTwoJoints) {
  InspectedArm arm("2R planar (vertical plane)");
  const Eigen::Index size = arm.log.tau.rows() - 3;
  const Eigen::MatrixXd tau = arm.log.tau;
  arm.log.tau.bottomRows(size) = tau.topRows(size);
  const ReadingFinding found =
      FindReading(arm.robot, UniformSeries(arm.log, .01, .05, 8));
  ASSERT_EQ(found.changes.size(), 1u);
  EXPECT_EQ(found.changes[0].kind, Kind::kDelay);
  EXPECT_NEAR(found.reading.delay, .03, .003);
}

// A sign of one joint of six is confirmed by its own torque; an order is not.
TEST(ReadingConfirmation, ASignIsConfirmedByItsOwnTorque) {
  const InspectedArm arm;
  const UniformSeries series(arm.log, .01, .05, 8);
  const ReadingState state(arm.robot, series);
  HeldOutFit as_is = state.held_out;
  as_is.joints.setConstant(.1);
  as_is.all.setConstant(.1);
  HeldOutFit changed = as_is;
  changed.joints.col(3).setConstant(.05);
  changed.all.setConstant(.06);
  changed.residual_percent *= .8;
  const auto is_confirmed = [&](Kind kind) {
    return IsConfirmed(state, {state.best, {kind, 3, 4}}, as_is, changed);
  };
  EXPECT_TRUE(is_confirmed(Kind::kTorqueSign));
  EXPECT_TRUE(is_confirmed(Kind::kPositionSign));
  EXPECT_FALSE(is_confirmed(Kind::kTorquesExchanged));
}

// Two joints whose torques hardly tell them apart: that one goes farther than
// the file lets it, and the other would not, decides, if torques fit better at
// all. It says nothing of a torque's order.
TEST(ReadingConfirmation, LimitsTellAnOrder) {
  InspectedArm arm;
  arm.log.q.col(3) *= .2;
  const auto is_confirmed = [&](Kind kind, double residual) {
    const UniformSeries series(arm.log, .01, .05, 8);
    const ReadingState state(arm.robot, series);
    HeldOutFit changed = state.held_out;
    changed.residual_percent *= residual;
    Candidate candidate{state.best, {kind, 3, 4}};
    if (kind == Kind::kExchanged) {
      std::swap(candidate.reading.wiring.position_column[3],
                candidate.reading.wiring.position_column[4]);
    }
    return IsConfirmed(state, candidate, state.held_out, changed);
  };
  EXPECT_FALSE(is_confirmed(Kind::kExchanged, .99));
  arm.robot.links[4].joint.upper = .5 * arm.log.q.col(4).maxCoeff();
  arm.robot.links[4].joint.lower = -arm.robot.links[4].joint.upper;
  ASSERT_LT(arm.log.q.col(3).cwiseAbs().maxCoeff(),
            arm.robot.links[4].joint.upper);
  EXPECT_TRUE(is_confirmed(Kind::kExchanged, .99));
  EXPECT_FALSE(is_confirmed(Kind::kExchanged, 1.01));
  EXPECT_FALSE(is_confirmed(Kind::kTorquesExchanged, .99));
  // Nor where the other joint is as far beyond its own.
  arm.robot.links[3].joint.velocity = 1e-3;
  EXPECT_FALSE(is_confirmed(Kind::kExchanged, .99));
}

// The PUMA's second and third axis are parallel, its first is not: where both
// signs fit alike, the one is told beside the other.
TEST(ReadingConfirmation, SignsOfParallelJointsAreToldBeside) {
  const InspectedArm arm;
  const UniformSeries series(arm.log, .01, .05, 8);
  const ReadingState state(arm.robot, series);
  std::vector<Candidate> all;
  for (int j = 0; j < 3; ++j) {
    all.push_back({state.best, {Kind::kPositionSign, j}});
  }
  const auto beside =
      AlternativesTo(1, state.held_out, {-100, -100, -100}, all, state);
  ASSERT_EQ(beside.size(), 1u);
  EXPECT_EQ(beside[0].joint, 2);
}

}  // namespace armcal::reading_confirmation_test
