#include "calib/inspect/position_unit.h"

#include <gtest/gtest.h>

#include "tests/fixtures/inspected_arm.h"

namespace armcal::position_unit_test {

class PositionUnitTest : public testing::Test {
 protected:
  PositionUnitHints Hints(const Log& log) const {
    const Eigen::MatrixXd qd = Eigen::MatrixXd::Ones(9, robot_.num_joints());
    return HintsOfPositionUnit(robot_, log, qd);
  }

  InspectedArm arm_;
  Robot robot_ = arm_.robot;
  Log log_ = arm_.log;
};

TEST_F(PositionUnitTest, ARightLogHasNoHint) {
  EXPECT_EQ(Hints(log_).degrees.evidence, "");
  EXPECT_EQ(Hints(log_).millimetres.evidence, "");
}

TEST_F(PositionUnitTest, VelocitiesTell) {
  log_.q *= 180 / M_PI;
  EXPECT_NE(Hints(log_).degrees.evidence.find("velocities"), std::string::npos);
  EXPECT_EQ(Hints(log_).millimetres.evidence, "");
  // One that is no slope in either unit.
  log_.qd.col(2) *= 3;
  EXPECT_EQ(Hints(log_).degrees.evidence, "");
}

// Positions that move too slowly in degrees to be judged are none: the velocity
// of one joint has the wrong sign.
TEST_F(PositionUnitTest, WhatIsNotJudgedInAUnitDoesNotTellIt) {
  log_.q *= .2;
  log_.qd *= .2;
  log_.qd.col(2) *= -1;
  EXPECT_EQ(Hints(log_).degrees.evidence, "");
}

// One of several joints, with a velocity that says so.
TEST_F(PositionUnitTest, OneJointInDegreesIsNotAllJoints) {
  Joint& joint = robot_.links[1].joint;
  joint.lower = -1.6;
  joint.upper = 1.6;
  log_.q.col(1) *= 180 / M_PI;
  EXPECT_EQ(Hints(log_).degrees.evidence, "");
  log_.qd.resize(0, 0);
  EXPECT_NE(Hints(log_).degrees.evidence, "");
}

// Between rad at the limit and degrees at it, in proportion: the root of 57.3.
TEST_F(PositionUnitTest, LimitsTellWhatIsCloserToThem) {
  log_.qd.resize(0, 0);
  Joint& joint = robot_.links[1].joint;
  joint.lower = -1;
  joint.upper = .5;
  // Of which a hundredth is beyond 1, and a glitch.
  log_.q.col(1) = Eigen::VectorXd::LinSpaced(log_.q.rows(), -1, 1) / .99;
  log_.q(7, 1) = 1e3;
  EXPECT_EQ(Hints(log_).degrees.evidence, "");
  log_.q.col(1) *= 7.4;
  EXPECT_EQ(Hints(log_).degrees.evidence, "");
  log_.q.col(1) *= 7.8 / 7.4;
  EXPECT_NE(Hints(log_).degrees.evidence.find("7.8 times its limits"),
            std::string::npos);
}

TEST_F(PositionUnitTest, JointsThatSlideHaveMillimetres) {
  log_.qd.resize(0, 0);
  robot_.links[1].joint.type = JointType::kPrismatic;
  robot_.links[1].joint.velocity = 1. / 40;
  EXPECT_NE(Hints(log_).millimetres.evidence.find("joint2"), std::string::npos);
  EXPECT_EQ(Hints(log_).degrees.evidence, "");
}

// Where joints cannot be as logged and can in the other unit; a velocity's
// limit may be a placeholder.
TEST_F(PositionUnitTest, OnlyPositionsAreOutOfReach) {
  log_.qd.resize(0, 0);
  Joint& joint = robot_.links[1].joint;
  joint.type = JointType::kPrismatic;
  joint.lower = -.4;
  joint.upper = .5;
  log_.q.col(1) = Eigen::VectorXd::LinSpaced(log_.q.rows(), -400, 490);
  EXPECT_TRUE(Hints(log_).millimetres.out_of_reach);
  log_.q.col(1) *= 1.1;  // mm that are beyond it, too
  EXPECT_FALSE(Hints(log_).millimetres.out_of_reach);
  log_.q.col(1) /= 1e3;
  joint.velocity = 1. / 40;
  EXPECT_NE(Hints(log_).millimetres.evidence, "");
  EXPECT_FALSE(Hints(log_).millimetres.out_of_reach);
}

}  // namespace armcal::position_unit_test
