#include "calib/inspect/log_reading.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/fixtures/inspected_arm.h"

namespace armcal::log_reading_test {

using Eigen::Vector3d;
using Kind = ReadingChange::Kind;

class LogReadingTest : public testing::Test {
 protected:
  ReadingFinding Read() const {
    return FindReading(robot_, UniformSeries(log_, .01, .05, 8));
  }
  // One change, of this kind and joint.
  void ExpectOne(Kind kind, int joint = -1, int other = -1) const {
    const ReadingFinding found = Read();
    ASSERT_EQ(found.changes.size(), 1u);
    EXPECT_EQ(found.changes[0].kind, kind);
    EXPECT_EQ(found.changes[0].joint, joint);
    EXPECT_EQ(found.changes[0].other, other);
    EXPECT_LT(found.residual_percent, .5 * found.residual_percent_as_is);
  }

  InspectedArm arm_;
  Robot robot_ = arm_.robot;
  Log log_ = arm_.log;
};

// Drive counts, 400 of them an N m: no sign is told for the unit, and one that
// is wrong is found beside it.
TEST_F(LogReadingTest, AUnitOfTorquesIsNoSign) {
  log_.tau *= 400;
  for (const bool is_negated : {false, true}) {
    if (is_negated) log_.tau.col(1) *= -1;
    const ReadingFinding found = Read();
    EXPECT_NEAR(std::log(400 * found.reading.torque_unit), 0, std::log(2.));
    std::vector<ReadingChange> others = found.changes;
    DropTorqueUnit(&others);
    ASSERT_EQ(others.size(), is_negated ? 1u : 0u);
    if (!is_negated) continue;
    EXPECT_EQ(others[0].kind, Kind::kTorqueSign);
    EXPECT_EQ(others[0].joint, 1);
  }
}

TEST_F(LogReadingTest, AsItIs) {
  const ReadingFinding found = Read();
  EXPECT_TRUE(found.changes.empty());
  EXPECT_LT(found.residual_percent, 5);
}

TEST_F(LogReadingTest, ExchangedJoints) {
  log_.q.col(1).swap(log_.q.col(2));
  log_.tau.col(1).swap(log_.tau.col(2));
  ExpectOne(Kind::kExchanged, 1, 2);
}

TEST_F(LogReadingTest, ExchangedPositionsAlone) {
  log_.q.col(1).swap(log_.q.col(2));
  ExpectOne(Kind::kPositionsExchanged, 1, 2);
}

TEST_F(LogReadingTest, ExchangedTorquesAlone) {
  log_.tau.col(0).swap(log_.tau.col(2));
  ExpectOne(Kind::kTorquesExchanged, 0, 2);
}

// Three joints' torques one place on: two exchanges.
TEST_F(LogReadingTest, TorquesInAnotherOrder) {
  log_.tau.col(0).swap(log_.tau.col(1));
  log_.tau.col(1).swap(log_.tau.col(2));
  const ReadingFinding found = Read();
  ASSERT_EQ(found.changes.size(), 2u);
  const std::vector<int> as_logged = {2, 0, 1, 3, 4, 5};
  EXPECT_EQ(found.reading.wiring.torque_column, as_logged);
  for (const ReadingChange& change : found.changes) {
    EXPECT_TRUE(change.alternatives.empty());
  }
}

// Noise in the torques' place tells no unit, and fits better by chance in a
// half of all cases: limits of speed say nothing then, and limits of position
// that it may be so. Recorded velocities need no torques.
TEST_F(LogReadingTest, AUnitThatTorquesDoNotTellIsADoubt) {
  const auto doubts_of = [&](const PositionUnitHint& hint, bool is_doubt) {
    int count = 0;
    std::mt19937_64 random(3);
    for (int k = 0; k < 6; ++k) {
      log_.tau.setZero();
      AddNoise(&random, Eigen::VectorXd::Ones(log_.tau.cols()), &log_.tau);
      ReadingHints hints;
      hints.asks_gravity = false;
      hints.units.degrees = hint;
      const ReadingFinding found =
          FindReading(robot_, UniformSeries(log_, .01, .05, 8), hints);
      for (const ReadingChange& change : found.changes) {
        if (change.kind != Kind::kDegrees) continue;
        EXPECT_EQ(change.is_doubt, is_doubt);
        ++count;
      }
    }
    return count;
  };
  EXPECT_EQ(doubts_of({"a limit of speed", false, false}, false), 0);
  EXPECT_GT(doubts_of({"limits of position", true, false}, true), 0);
  EXPECT_GT(doubts_of({"velocities", true, true}, false), 0);
}

// The base's joint turns about gravity and the others rest: nothing tells which
// way.
TEST_F(LogReadingTest, TheSignOfEitherSignal) {
  const Eigen::MatrixXd first = log_.q.col(0);
  log_.q.rowwise() = log_.q.row(0).eval();
  log_.q.col(0) = first;
  log_.qd.rightCols(5).setZero();
  log_.qdd.rightCols(5).setZero();
  log_.tau.setZero();
  AddTorque(robot_, &log_);
  log_.tau.col(0) *= -1;
  const ReadingFinding found = Read();
  ASSERT_EQ(found.changes.size(), 1u);
  EXPECT_EQ(found.changes[0].joint, 0);
  // Nor whether what rests is turned round with it.
  ASSERT_EQ(found.changes[0].alternatives.size(), 3u);
  EXPECT_TRUE(IsOneSign(found.changes[0].kind));
  int single = 0;
  for (const ReadingChange& other : found.changes[0].alternatives) {
    EXPECT_TRUE(IsAllSigns(other.kind) || IsOneSign(other.kind));
    if (!IsOneSign(other.kind)) continue;
    ++single;
    EXPECT_NE(other.kind, found.changes[0].kind);
    EXPECT_EQ(other.joint, 0);
  }
  EXPECT_EQ(single, 1);
}

// Velocities in rad/s, or positions far beyond the file's limits.
TEST_F(LogReadingTest, AUnitWithAHintHasToFitNoWorse) {
  log_.q *= 180 / M_PI;
  ReadingHints hints;
  hints.units.degrees.evidence = "the limits";
  const ReadingFinding found =
      FindReading(robot_, UniformSeries(log_, .01, .05, 8), hints);
  ASSERT_EQ(found.changes.size(), 1u);
  EXPECT_EQ(found.changes[0].hint, "the limits");
  EXPECT_TRUE(found.reading.units.degrees);
  log_ = arm_.log;
  EXPECT_TRUE(FindReading(robot_, UniformSeries(log_, .01, .05, 8), hints)
                  .changes.empty());
}

// A mass moved in mm explains forces as well as one a thousand times as heavy
// moved in m: where it can be decides. Torques that object are heard: those of
// an arm that turns.
TEST_F(LogReadingTest, PositionsOutOfReachDecideWhereTorquesCannot) {
  ReadingHints hints;
  hints.units.degrees = {"the limits", true};
  EXPECT_TRUE(FindReading(robot_, UniformSeries(log_, .01, .05, 8), hints)
                  .changes.empty());
  robot_.links.resize(1);
  robot_.links[0].joint.type = JointType::kPrismatic;
  Log log = log_;
  log.q.conservativeResize(Eigen::NoChange, 1);
  log.tau.conservativeResize(Eigen::NoChange, 1);
  log.qd.resize(0, 0);
  for (Eigen::Index k = 0; k < log.q.rows(); ++k) {
    const double t = log.t[k] - log.t[0];
    log.q(k, 0) = 200 * std::sin(3 * t);
    log.tau(k, 0) = -30 * .2 * 9 * std::sin(3 * t);
  }
  hints.units = {};
  EXPECT_TRUE(FindReading(robot_, UniformSeries(log, .01, .05, 8), hints)
                  .changes.empty());
  hints.units.millimetres = {"the limits", true};
  const ReadingFinding found =
      FindReading(robot_, UniformSeries(log, .01, .05, 8), hints);
  ASSERT_EQ(found.changes.size(), 1u);
  EXPECT_TRUE(found.reading.units.millimetres);
}

TEST_F(LogReadingTest, SignOfThePosition) {
  log_.q.col(2) *= -1;
  ExpectOne(Kind::kPositionSign, 2);
}

TEST_F(LogReadingTest, SignOfTheTorque) {
  log_.tau.col(5) *= -1;
  ExpectOne(Kind::kTorqueSign, 5);
}

TEST_F(LogReadingTest, SignOfBoth) {
  log_.q.col(1) *= -1;
  log_.tau.col(1) *= -1;
  ExpectOne(Kind::kJointSign, 1);
}

TEST_F(LogReadingTest, TwoFaults) {
  log_.q.col(0) *= -1;
  log_.tau.col(3) *= -1;
  const ReadingFinding found = Read();
  ASSERT_EQ(found.changes.size(), 2u);
  EXPECT_EQ(found.reading.wiring.position_sign[0], -1);
  EXPECT_EQ(found.reading.wiring.torque_sign[3], -1);
}

// Friction would give power and masses be negative: no sign of one joint mends
// that, and none is claimed.
TEST_F(LogReadingTest, AllTorquesTurnedRound) {
  log_.tau *= -1;
  ExpectOne(Kind::kAllTorqueSigns);
  EXPECT_EQ(Read().reading.wiring.torque_sign,
            Eigen::VectorXd::Constant(6, -1));
}

TEST_F(LogReadingTest, AllPositionsTurnedRound) {
  log_.q *= -1;
  ExpectOne(Kind::kAllPositionSigns);
}

TEST_F(LogReadingTest, AllTorquesTurnedRoundButOne) {
  log_.tau.leftCols(5) *= -1;
  const ReadingFinding found = Read();
  ASSERT_EQ(found.changes.size(), 2u);
  EXPECT_EQ(found.changes[0].kind, Kind::kAllTorqueSigns);
  EXPECT_EQ(found.changes[1].kind, Kind::kTorqueSign);
  EXPECT_EQ(found.changes[1].joint, 5);
}

TEST_F(LogReadingTest, Degrees) {
  log_.q *= 180 / M_PI;
  ExpectOne(Kind::kDegrees);
}

TEST_F(LogReadingTest, GravityElsewhere) {
  const Vector3d truth = robot_.gravity;
  robot_.gravity = Eigen::AngleAxisd(.5, Vector3d::UnitX()) * robot_.gravity;
  const ReadingFinding found = Read();
  ASSERT_EQ(found.changes.size(), 1u);
  EXPECT_EQ(found.changes[0].kind, Kind::kGravity);
  EXPECT_LT((found.reading.gravity - truth).norm(), .05 * truth.norm());
}

TEST_F(LogReadingTest, GravityThatIsNotAskedFor) {
  robot_.gravity = Eigen::AngleAxisd(.5, Vector3d::UnitX()) * robot_.gravity;
  for (const ReadingChange& change :
       FindReading(robot_, UniformSeries(log_, .01, .05, 8), {{}, false, {}})
           .changes) {
    EXPECT_NE(change.kind, Kind::kGravity);
  }
}

TEST_F(LogReadingTest, TorquesWithoutGravity) {
  Robot weightless = robot_;
  weightless.gravity.setZero();
  Log other = log_;
  other.tau.setZero();
  AddTorque(robot_, &other);
  log_.tau -= other.tau;
  other.tau.setZero();
  AddTorque(weightless, &other);
  log_.tau += other.tau;
  const ReadingFinding found = Read();
  ASSERT_EQ(found.changes.size(), 1u);
  EXPECT_EQ(found.changes[0].kind, Kind::kGravity);
  EXPECT_EQ(found.reading.gravity.norm(), 0);
}

// Rows are 10 ms apart: the torque of two rows before.
TEST_F(LogReadingTest, LateTorques) {
  const Eigen::Index size = log_.tau.rows() - 2;
  log_.tau.bottomRows(size) = arm_.log.tau.topRows(size);
  const ReadingFinding found = Read();
  ASSERT_EQ(found.changes.size(), 1u);
  EXPECT_EQ(found.changes[0].kind, Kind::kDelay);
  EXPECT_NEAR(found.reading.delay, .02, .003);
}

// One column came from elsewhere than the others: of a file without limits
// torques tell which, and of one with limits of half a turn not all joints'
// positions are in degrees because one is beyond them.
TEST_F(LogReadingTest, OneColumnInDegrees) {
  log_.q.col(1) *= 180 / M_PI;
  log_.qd.col(1) *= 180 / M_PI;
  for (const bool has_limits : {false, true}) {
    ReadingHints hints;
    for (Link& link : robot_.links) {
      if (!has_limits) continue;
      link.joint.lower = -M_PI;
      link.joint.upper = M_PI;
    }
    const UniformSeries series(log_, .01, .05, 8);
    hints.units = HintsOfPositionUnit(robot_, log_, series.motion().qd);
    EXPECT_EQ(!hints.units.degrees.evidence.empty(), has_limits);
    const ReadingFinding found = FindReading(robot_, series, hints);
    ASSERT_EQ(found.changes.size(), 1u);
    EXPECT_EQ(found.changes[0].kind, Kind::kDegrees);
    EXPECT_EQ(found.changes[0].joint, 1);
    const Joint& joint = robot_.links[1].joint;
    EXPECT_DOUBLE_EQ(found.reading.units.Of(joint, 1), M_PI / 180);
    EXPECT_EQ(found.reading.units.Of(joint, 2), 1);
    EXPECT_LT(found.residual_percent, 5);
  }
}

}  // namespace armcal::log_reading_test
