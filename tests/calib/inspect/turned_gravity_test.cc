#include "calib/inspect/turned_gravity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calib/inspect/log_reading.h"
#include "calib/inspect/reading_candidates.h"
#include "tests/fixtures/inspected_arm.h"

namespace armcal::turned_gravity_test {

using Kind = ReadingChange::Kind;

// An arm that moves ten times as slowly as others do: gravity and friction are
// nearly all of its torque.
class SlowArmTest : public testing::Test {
 protected:
  SlowArmTest() {
    std::mt19937_64 random(5);
    Multisine motion = RandomMultisine(&random, robot_.num_joints());
    log_ = RecordMotion(motion, 4, .002);
    log_.t *= 10;  // rows are 20 ms apart
    log_.qd /= 10;
    log_.qdd /= 100;
    AddTorque(robot_, &log_);
    for (int j = 0; j < robot_.num_joints(); ++j) {
      AddCoulomb(j, 2, {CoulombTransition::Law::kVelocity, .02}, &log_);
    }
    AddNoise(&random, .01 * ColumnRms(log_.tau), &log_.tau);
  }
  ReadingFinding Read() const {
    return FindReading(robot_, UniformSeries(log_, .02, .1, 4));
  }

  Robot robot_ = InspectedArm().robot;
  Log log_;
};

TEST_F(SlowArmTest, RightGravityIsNotTurned) {
  EXPECT_TRUE(Read().changes.empty());
}

TEST_F(SlowArmTest, GravityIsTurnedAsTheFilesBodiesSay) {
  const Eigen::Vector3d truth = robot_.gravity;
  robot_.gravity *= -1;
  const ReadingFinding found = Read();
  ASSERT_EQ(found.changes.size(), 1u);
  EXPECT_EQ(found.changes[0].kind, Kind::kGravity);
  EXPECT_NEAR((found.reading.gravity - truth).norm(), 0, 1e-9);
}

TEST_F(SlowArmTest, BodiesAreJudgedByWhatNoneLeave) {
  const UniformSeries series(log_, .02, .1, 4);
  const WiringSamples samples =
      SamplesAs(LogReading(robot_), robot_, series, 250);
  const BodiesOfFile right(TorqueFit(robot_, samples.motion), samples.tau);
  robot_.gravity *= -1;
  const BodiesOfFile wrong(TorqueFit(robot_, samples.motion), samples.tau);
  // The file's bodies are the arm's, and terms explain the rest of its torque.
  EXPECT_LT(right.percent_left, 5);
  EXPECT_LT(right.all, .01);
  EXPECT_GT(wrong.all, 1);
  EXPECT_TRUE(AreOfTurnedGravity(wrong, right));
  EXPECT_FALSE(AreOfTurnedGravity(right, wrong));
  EXPECT_FALSE(AreOfTurnedGravity(right, right));
}

// Gravity that was found while all torques had the wrong sign may be turned.
TEST(TurnedGravity, IsTriedWithAllTorques) {
  const LogReading reading{InspectedArm().robot};
  std::vector<Candidate> all =
      WiringCandidates(reading, std::vector<bool>(6, true));
  const size_t size = all.size();
  AddTurnedGravity(&all);
  ASSERT_EQ(all.size(), size + 1);
  int turned = 0;
  for (const Candidate& candidate : all) {
    if (candidate.reading.gravity == reading.gravity) continue;
    ++turned;
    EXPECT_EQ(candidate.reading.gravity, -reading.gravity);
    EXPECT_EQ(candidate.change.kind, Kind::kAllTorqueSigns);
    EXPECT_EQ(candidate.reading.wiring.torque_sign,
              Eigen::VectorXd::Constant(6, -1));
  }
  EXPECT_EQ(turned, 1);
}

// "--gravity=-9.81,-0,-0" is no advice.
TEST(TurnedGravity, HasNoMinusZeros) {
  LogReading reading{InspectedArm().robot};
  reading.gravity = {9.81, 0, 0};
  std::vector<Candidate> all = GravityCandidates(reading, 9.81);
  all.push_back({WithTurnedGravity(reading), {Kind::kGravity}});
  for (const Candidate& candidate : all) {
    for (const double g : candidate.reading.gravity) {
      EXPECT_FALSE(g == 0 && std::signbit(g));
    }
  }
}

}  // namespace armcal::turned_gravity_test
