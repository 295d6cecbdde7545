#include "calib/logs/position_jumps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures/inspected_arm.h"

namespace armcal::position_jumps_test {

using Eigen::VectorXd;

class PositionJumpsTest : public testing::Test {
 protected:
  PositionJumpsTest() : arm_("3R elbow") {}

  LogJumps Jumps(const Log& log) const {
    return FindPositionJumps(arm_.robot, log);
  }
  static void ExpectNothingToMend(const PositionJumps& jumps) {
    EXPECT_TRUE(jumps.spikes.empty());
    EXPECT_TRUE(jumps.wraps.empty());
  }
  void ExpectNone(const Log& log) const {
    const LogJumps jumps = Jumps(log);
    EXPECT_TRUE(jumps.missing_time.empty());
    for (const PositionJumps& of_joint : jumps.joints) {
      ExpectNothingToMend(of_joint);
      EXPECT_TRUE(of_joint.steps.empty());
    }
  }
  // Half a second from 10 s on is cut out, and the stamps closed up.
  Log WithoutHalfASecond() const {
    Log log;
    const Eigen::Index rows = arm_.log.size() - 50;
    log.t = arm_.log.t.head(rows);
    log.q.resize(rows, 3);
    log.q << arm_.log.q.topRows(1000), arm_.log.q.bottomRows(rows - 1000);
    return log;
  }
  // How far a joint's mended position is from that before it was spoilt.
  double LeftAfterMending(const Log& spoilt, int j) const {
    Log mended = spoilt;
    MendJumps(Jumps(spoilt), &mended);
    return (mended.q.col(j) - arm_.log.q.col(j)).cwiseAbs().maxCoeff();
  }

  InspectedArm arm_;
};

TEST_F(PositionJumpsTest, MotionHasNone) {
  ExpectNone(arm_.log);
  Log rounded = arm_.log;  // to the resolution of a hobby servo
  rounded.q = (rounded.q.array() / .0015).round() * .0015;
  ExpectNone(rounded);
  Log held = arm_.log;  // new in every eighth row
  for (int k = 0; k < held.size(); ++k) held.q.row(k) = held.q.row(k - k % 8);
  ExpectNone(held);
  Log noisy = arm_.log;
  std::mt19937_64 random(1);
  AddNoise(&random, VectorXd::Constant(3, .01), &noisy.q);
  ExpectNone(noisy);
  Log hole = WithoutHalfASecond();  // that its stamps show
  hole.t.tail(hole.size() - 1000).array() += .5;
  ExpectNone(hole);
}

TEST_F(PositionJumpsTest, SpikesComeBack) {
  Log log = arm_.log;
  log.q(700, 1) += 1;
  log.q.col(1).segment(900, 4).setZero();  // a lost connection
  const LogJumps jumps = Jumps(log);
  ASSERT_EQ(jumps.joints[1].spikes.size(), 2u);
  EXPECT_EQ(jumps.joints[1].spikes[0].begin, 700);
  EXPECT_EQ(jumps.joints[1].spikes[0].end, 701);
  EXPECT_EQ(jumps.joints[1].spikes[1].begin, 900);
  EXPECT_EQ(jumps.joints[1].spikes[1].end, 904);
  EXPECT_TRUE(jumps.joints[1].steps.empty());
  EXPECT_TRUE(jumps.missing_time.empty());
  ExpectNothingToMend(jumps.joints[0]);
  // Of five steps of .01 s: a parabola's sagitta at 30 rad/s^2.
  EXPECT_LT(LeftAfterMending(log, 1), 30 * .05 * .05 / 8);
}

// A row of no measurement, as loggers write after a dropout, in one line with
// the others or after a hole: no time is missing there.
TEST_F(PositionJumpsTest, AWrongRowIsNoMissingTime) {
  for (const double hole : {0., .6}) {
    Log log = arm_.log;
    log.t.tail(log.size() - 700).array() += hole;
    log.q.row(700).setConstant(-M_PI);
    log.tau.row(700).setZero();
    const LogJumps jumps = Jumps(log);
    EXPECT_TRUE(jumps.missing_time.empty());
    ASSERT_EQ(jumps.wrong_rows.size(), 1u);
    EXPECT_EQ(jumps.wrong_rows[0].begin, 700);
    EXPECT_EQ(jumps.wrong_rows[0].end, 701);
    for (const PositionJumps& of_joint : jumps.joints) {
      EXPECT_EQ(of_joint.spikes.size(), 1u);
      EXPECT_TRUE(of_joint.steps.empty());
    }
    MendJumps(jumps, &log);
    EXPECT_LT((log.q.row(700) - arm_.log.q.row(700)).norm(), .05);
    EXPECT_GT(log.tau.row(700).cwiseAbs().minCoeff(), 0);
  }
}

// Zeros in all columns while a joint is about to pass zero: going there is a
// jump and coming back is none, or the other way round. Its zero is not lost.
TEST_F(PositionJumpsTest, ARowOfZerosNearZeroIsNoLostZero) {
  int near_zero = 0;
  for (int row = 300; row < 1700; row += 7) {
    for (const double before : {.02, .03, .05, .08}) {
      Log log = arm_.log;
      log.q.col(0).array() += 1 - log.q(row, 0);  // far from zero
      log.q.col(1).array() += before - log.q(row - 1, 1);
      log.q.row(row).setZero();
      const LogJumps jumps = Jumps(log);
      EXPECT_TRUE(jumps.joints[1].steps.empty()) << row << " " << before;
      near_zero += static_cast<int>(jumps.joints[1].spikes.size());
    }
  }
  EXPECT_GT(near_zero, 0);
}

TEST_F(PositionJumpsTest, AnEncoderThatWrapsIsUnwrapped) {
  Log wraps = arm_.log;
  for (double& q : wraps.q.col(0)) q = q > .1 ? q - 2 * M_PI : q;
  const LogJumps jumps = Jumps(wraps);
  EXPECT_FALSE(jumps.joints[0].wraps.empty());
  EXPECT_TRUE(jumps.joints[0].steps.empty());
  Log mended = wraps;
  MendJumps(jumps, &mended);
  const VectorXd off = mended.q.col(0) - arm_.log.q.col(0);
  EXPECT_LT((off.array() - off[0]).abs().maxCoeff(), 1e-9);
  EXPECT_NEAR(std::remainder(off[0], 2 * M_PI), 0, 1e-9);
}

TEST_F(PositionJumpsTest, AZeroThatIsLostStaysLost) {
  Log log = arm_.log;
  log.q.col(2).tail(800).array() += .3;
  const LogJumps jumps = Jumps(log);
  ASSERT_EQ(jumps.joints[2].steps.size(), 1u);
  EXPECT_EQ(jumps.joints[2].steps[0].row, log.size() - 800);
  EXPECT_NEAR(jumps.joints[2].steps[0].size, .3, .05);
  EXPECT_NEAR(LeftAfterMending(log, 2), .3, 1e-9);
}

// Rows 500 to 699 have another zero; of one that is lost for good the shorter
// side is left out.
TEST_F(PositionJumpsTest, RowsOfTheRarerZeroAreLeftOut) {
  EXPECT_TRUE(RowsOfOtherZeros(Jumps(arm_.log), arm_.log.size()).empty());
  Log log = arm_.log;
  log.q.col(2).segment(500, 200).array() += .3;
  const std::vector<RowRange> between =
      RowsOfOtherZeros(Jumps(log), log.size());
  ASSERT_EQ(between.size(), 1u);
  EXPECT_EQ(between[0].begin, 500);
  EXPECT_EQ(between[0].end, 700);
  log.q.col(0).tail(600).array() -= .3;
  const std::vector<RowRange> both = RowsOfOtherZeros(Jumps(log), log.size());
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].begin, log.size() - 600);
  EXPECT_EQ(both[0].end, log.size());
}

// Of the last 500 rows, which a crop uses, all have the zero that is lost.
TEST_F(PositionJumpsTest, RowsOfAZeroCountWhereTheyAreUsed) {
  Log log = arm_.log;
  const int size = log.size();
  log.q.col(2).tail(600).array() += .3;
  const std::vector<RowRange> others =
      RowsOfOtherZeros(Jumps(log), size, {{size - 500, size}});
  ASSERT_EQ(others.size(), 1u);
  EXPECT_EQ(others[0].begin, 0);
  EXPECT_EQ(others[0].end, size - 600);
}

// A second step of a sixth of the first does not take it back.
TEST_F(PositionJumpsTest, ASmallerStepLeadsToAnotherZero) {
  Log log = arm_.log;
  const int size = log.size();
  log.q.col(2).tail(1500).array() += 1;
  log.q.col(2).tail(600).array() += .18;
  const LogJumps jumps = Jumps(log);
  ASSERT_EQ(jumps.joints[2].steps.size(), 2u);
  EXPECT_EQ(RowsOfOtherZeros(jumps, size).size(), 2u);
}

TEST_F(PositionJumpsTest, TimeThatIsMissingIsNoEncoders) {
  const LogJumps jumps = Jumps(WithoutHalfASecond());
  ASSERT_EQ(jumps.missing_time.size(), 1u);
  EXPECT_EQ(jumps.missing_time[0], 1000);
  for (const PositionJumps& of_joint : jumps.joints) {
    ExpectNothingToMend(of_joint);
  }
}

// Rows lost twice within a tenth of a second: both steps go the joint's way,
// and no rows between them are elsewhere.
TEST_F(PositionJumpsTest, LossesInARowAreNoSpikes) {
  Log log;
  log.t = VectorXd::LinSpaced(20000, 0, 19.999);
  log.q.resize(20000, 3);
  for (int k = 0, sample = 0; k < 20000; ++k, ++sample) {
    if (k == 10575 || k == 10665) sample += 10;  // at 3/4 of the top speed
    const double t = .001 * sample;
    log.q.row(k) << .5 * std::sin(.4 * M_PI * t), .4 * std::sin(.4 * M_PI * t),
        .3 * std::sin(.5 * M_PI * t);
  }
  const LogJumps jumps = Jumps(log);
  EXPECT_TRUE(jumps.wrong_rows.empty());
  for (const PositionJumps& of_joint : jumps.joints) {
    ExpectNothingToMend(of_joint);
  }
  ASSERT_EQ(jumps.missing_time.size(), 2u);
  EXPECT_EQ(jumps.missing_time[0], 10575);
  EXPECT_EQ(jumps.missing_time[1], 10665);
}

}  // namespace armcal::position_jumps_test
