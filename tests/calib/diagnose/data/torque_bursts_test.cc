#include "calib/diagnose/data/torque_bursts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures/sample_robots.h"

namespace armcal::torque_bursts_test {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kStep = .01;  // s
constexpr int kSamples = 3000;
constexpr double kBandwidth = 8;  // Hz

// Two joints that swing for 30 s with 20 and 5 N m; reconstructed torques.
GapSegment Swing() {
  GapSegment segment;
  segment.reconstructed_torque = true;
  segment.motion.dt = kStep;
  segment.motion.q = segment.motion.qd = segment.motion.qdd = segment.tau =
      Eigen::MatrixXd::Zero(kSamples, 2);
  segment.still.setConstant(kSamples, 2, false);
  for (int k = 0; k < kSamples; ++k) {
    const double wave = std::sqrt(2) * std::sin(2 * M_PI * k * kStep);
    segment.tau.row(k) << 20 * wave, 5 * wave;
  }
  return segment;
}

// Adds 20 Hz to a joint, between two samples.
void Ring(int joint, int begin, int end, double rms, GapSegment* segment) {
  for (int k = begin; k < end; ++k) {
    segment->tau(k, joint) +=
        std::sqrt(2) * rms * std::sin(2 * M_PI * 20 * k * kStep);
  }
}

// The second joint between 12 and 13 s.
GapSegment Burst() {
  GapSegment segment = Swing();
  Ring(1, 1200, 1300, 15000, &segment);
  return segment;
}

std::vector<TorqueBurst> Find(const GapSegment& segment) {
  return FindTorqueBursts(segment, kBandwidth);
}

TEST(TorqueBursts, AreFoundWhereTheyAre) {
  EXPECT_THAT(Find(Swing()), IsEmpty());
  const std::vector<TorqueBurst> bursts = Find(Burst());
  ASSERT_THAT(bursts, SizeIs(3)) << "filters spread it to its neighbours";
  EXPECT_EQ(bursts[1].joint, 1);
  EXPECT_NEAR(bursts[1].window.begin, 12, kStep);
  EXPECT_NEAR(bursts[1].window.end, 13, kStep);
  EXPECT_NEAR(bursts[1].usual, 5, .01);
  EXPECT_NEAR(bursts[1].fast, 15000, 300);
  for (const TimeRange& time : TimesOf(bursts, kBandwidth)) {
    EXPECT_TRUE(time.Contains(12.5));
    EXPECT_FALSE(time.Contains(8) || time.Contains(17));
  }
}

// A loop next to its stability rings wherever the arm is heavy, a third of the
// time.
TEST(TorqueBursts, AreFoundAgainAndAgain) {
  GapSegment segment = Swing();
  for (const int begin : {100, 1000, 1900}) {
    Ring(0, begin, begin + 300, 60, &segment);
  }
  const std::vector<TorqueBurst> bursts = Find(segment);
  EXPECT_THAT(bursts, SizeIs(9));
  EXPECT_NEAR(bursts.at(0).usual, 20, .5);
  for (const TimeRange& time : TimesOf(bursts, kBandwidth)) {
    EXPECT_LT(time.end - time.begin, 2.6);
  }
}

// What encoders' noise makes of a torque, it makes all the time.
TEST(TorqueBursts, AreNoNoise) {
  GapSegment segment = Swing();
  Ring(1, 0, kSamples, 10, &segment);
  EXPECT_THAT(Find(segment), IsEmpty());
}

// What a joint takes while it rests says nothing of what it takes to move.
TEST(TorqueBursts, AreNoMotionsAfterALongRest) {
  GapSegment segment = Swing();
  segment.tau.col(1).head(2800) *= 1e-3;
  segment.still.col(1).head(2800).setConstant(true);
  EXPECT_THAT(Find(segment), IsEmpty());
}

// Drives limit what they record.
TEST(TorqueBursts, AreOfReconstructedTorquesOnly) {
  GapSegment segment = Burst();
  segment.reconstructed_torque = false;
  EXPECT_THAT(Find(segment), IsEmpty());
}

TEST(TorqueBursts, AreNotUsual) {
  GapSegment segment = Burst();
  EXPECT_GT(UsualTorque({segment})[1], 1000);
  segment.lost = TimesOf(Find(segment), kBandwidth);
  EXPECT_NEAR(UsualTorque({segment})[0], 20, .1);
  EXPECT_NEAR(UsualTorque({segment})[1], 5, .1);
}

TEST(TorqueBursts, AreTold) {
  const Robot robot = SampleRobot("2R planar (horizontal)");
  EXPECT_THAT(TellTorqueBursts(robot, {Swing()}, kBandwidth), IsEmpty());
  const std::vector<DataFinding> told =
      TellTorqueBursts(robot, {Swing(), Burst()}, kBandwidth);
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_THAT(told[0].evidence, HasSubstr("between 12 and 13 s"));
  EXPECT_THAT(told[0].evidence, HasSubstr(robot.links[1].joint.name));
}

}  // namespace armcal::torque_bursts_test
