#include "calib/inspect/stuck_positions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calib/inspect/inspection.h"
#include "calib/logs/stamp_audit.h"
#include "model/log_files/log_source.h"
#include "tests/fixtures/inspected_arm.h"

namespace armcal::stuck_positions_test {

class StuckPositionsTest : public testing::Test {
 protected:
  StuckPositionsTest() : arm_("3R elbow"), log_(arm_.log) {
    for (int k = 300; k < 1600; ++k) {
      const auto gone = [&](int row) {
        return std::abs(log_.q(row + kRows, 1) - log_.q(row, 1));
      };
      if (gone(k) > gone(at_)) at_ = k;
    }
  }

  void Hold(int begin, int rows, int j) {
    log_.q.col(j).segment(begin, rows).setConstant(log_.q(begin, j));
  }
  std::vector<FrozenChannel> Stuck() const {
    return FindStuckPositions(arm_.robot, log_);
  }
  LogInspection Inspected() const {
    LogReaderOptions options;
    options.joint_names = arm_.robot.JointNames();
    return InspectLog(arm_.robot, LogSource("log.csv", log_), options);
  }

  static constexpr int kRows = 40;  // .4 s
  InspectedArm arm_;
  Log log_;
  int at_ = 300;  // joint 2 goes far in the rows after it
};

TEST_F(StuckPositionsTest, AMotionHasNone) {
  EXPECT_TRUE(Stuck().empty());
  log_.q = (log_.q.array() / .0015).round() * .0015;
  EXPECT_TRUE(Stuck().empty());
}

TEST_F(StuckPositionsTest, OnesThatAreNotAnsweredAre) {
  Hold(at_, kRows, 1);
  Hold(at_ + 150, 25, 0);
  const std::vector<FrozenChannel> stuck = Stuck();
  ASSERT_GE(stuck.size(), 1u);
  EXPECT_EQ(stuck.back().joint, 1);
  EXPECT_TRUE(stuck.back().is_position);
  EXPECT_EQ(stuck.back().begin, at_);
  EXPECT_EQ(stuck.back().end, at_ + kRows);
  EXPECT_NEAR(stuck.back().jump,
              arm_.log.q(at_ + kRows, 1) - arm_.log.q(at_, 1), 1e-12);
}

// It is told, and nothing is made of the motion that it seems to be.
TEST_F(StuckPositionsTest, AnInspectionGoesOnWithoutThem) {
  Hold(at_, kRows, 1);
  const LogInspection inspection = Inspected();
  ASSERT_EQ(inspection.findings.size(), 1u);
  EXPECT_EQ(inspection.findings[0].finding, "stuck");
  EXPECT_EQ(inspection.findings[0].joint, 1);
  EXPECT_LT(inspection.residual_percent, 5);
  const Log mended = Mended(arm_.robot, log_, inspection);
  EXPECT_EQ(mended.size(), log_.size() - kRows);
}

// A controller of 5 Hz in a log of 100 Hz.
TEST_F(StuckPositionsTest, HeldValuesAreNone) {
  for (int k = 0; k < log_.size(); ++k) log_.q.row(k) = log_.q.row(k - k % 20);
  EXPECT_TRUE(Stuck().empty());
}

// The arm rests, and a log of elsewhere begins.
TEST_F(StuckPositionsTest, WhereTwoLogsMeetThereAreNone) {
  for (int j = 0; j < 3; ++j) {
    Hold(at_, kRows, j);
    log_.q.col(j).tail(log_.size() - at_ - kRows).array() += 1;
  }
  EXPECT_TRUE(Stuck().empty());
}

// It rests, starts slowly and goes on.
TEST_F(StuckPositionsTest, ARestIsNone) {
  const double dt = .01;
  for (int k = 0; k < log_.size(); ++k) {
    const double t = std::max(0., std::sin(k * dt));
    log_.q(k, 0) = t * t;
  }
  EXPECT_TRUE(Stuck().empty());
}

// It loses its zero while it rests, or is not answered until it rests.
TEST_F(StuckPositionsTest, AZeroLostInARestIsAJump) {
  for (int k = 0; k < log_.size(); ++k) {
    const double t = std::max(0., std::sin(.01 * k));
    log_.q(k, 0) = t * t;
  }
  const int lost = 470;  // the joint rests from row 315 to row 628
  Log at_rest = log_;
  at_rest.q.col(0).tail(log_.size() - lost).array() += .3;
  EXPECT_TRUE(FindStuckPositions(arm_.robot, at_rest).empty());
  LogJumps jumps = FindPositionJumps(arm_.robot, at_rest);
  AddZerosLostAtRest(arm_.robot, at_rest, &jumps);
  ASSERT_EQ(jumps.joints[0].steps.size(), 1u);
  EXPECT_EQ(jumps.joints[0].steps[0].row, lost);
  EXPECT_NEAR(jumps.joints[0].steps[0].size, .3, 1e-12);
  Hold(240, 120, 0);  // from motion to rest
  const std::vector<FrozenChannel> stuck = Stuck();
  ASSERT_EQ(stuck.size(), 1u);
  EXPECT_EQ(stuck[0].end, 360);
  jumps = FindPositionJumps(arm_.robot, log_);
  AddZerosLostAtRest(arm_.robot, log_, &jumps);
  EXPECT_TRUE(jumps.joints[0].steps.empty());
}

// Rows that were left out before count on.
TEST_F(StuckPositionsTest, TorquesAreAskedWithoutThem) {
  Hold(at_, kRows, 1);
  log_.q.col(2).head(200).array() += .5;  // another zero
  const LogJumps jumps = FindPositionJumps(arm_.robot, log_);
  Eigen::Index row = 0;
  const Eigen::VectorXd tau = log_.tau.col(1);
  tau.tail(300).head(200).cwiseAbs().maxCoeff(&row);
  const int begin = static_cast<int>(row + log_.size() - 300);
  log_.tau.col(1).segment(begin, 50).setZero();
  const auto frozen = FindAllFrozenChannels(arm_.robot, log_, jumps,
                                            AuditStamps(log_).mean_step);
  ASSERT_EQ(frozen.size(), 2u);
  EXPECT_EQ(frozen[0].begin, at_);
  EXPECT_FALSE(frozen[1].is_position);
  EXPECT_EQ(frozen[1].begin, begin);
  EXPECT_EQ(frozen[1].end, begin + 50);
}

}  // namespace armcal::stuck_positions_test
