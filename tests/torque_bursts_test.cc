#include "calib/torque_bursts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/sample_robots.h"

namespace armcal {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kStep = .01;  // s
constexpr int kSamples = 3000;

// Two joints that swing for 30 s with 20 and 5 N m; made torques.
GapSegment Swing() {
  GapSegment segment;
  segment.made_torque = true;
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

// The second joint between 12.3 and 12.8 s.
GapSegment Burst() {
  GapSegment segment = Swing();
  segment.tau.col(1).segment(1230, 50) *= 3000;
  return segment;
}

TEST(TorqueBursts, AreFoundWhereTheyAre) {
  EXPECT_THAT(FindTorqueBursts(Swing()), IsEmpty());
  const std::vector<TorqueBurst> bursts = FindTorqueBursts(Burst());
  ASSERT_THAT(bursts, SizeIs(1));
  EXPECT_EQ(bursts[0].joint, 1);
  EXPECT_NEAR(bursts[0].window.begin, 12, kStep);
  EXPECT_NEAR(bursts[0].window.end, 13, kStep);
  EXPECT_NEAR(bursts[0].usual, 5, .01);
  EXPECT_NEAR(bursts[0].rms, 5 * 3000 / std::sqrt(2), 100);
  const std::vector<TimeRange> times = TimesOf(bursts);
  ASSERT_THAT(times, SizeIs(1));
  EXPECT_TRUE(times[0].Contains(11) && times[0].Contains(14));
  EXPECT_FALSE(times[0].Contains(9) || times[0].Contains(16));
}

// What a joint takes while it rests says nothing of what it takes to move.
TEST(TorqueBursts, AreNoMotionsAfterALongRest) {
  GapSegment segment = Swing();
  segment.tau.col(1).head(2800) *= 1e-3;
  segment.still.col(1).head(2800).setConstant(true);
  EXPECT_THAT(FindTorqueBursts(segment), IsEmpty());
}

// Drives limit what they record.
TEST(TorqueBursts, AreOfMadeTorquesOnly) {
  GapSegment segment = Burst();
  segment.made_torque = false;
  EXPECT_THAT(FindTorqueBursts(segment), IsEmpty());
}

TEST(TorqueBursts, AreNotUsual) {
  GapSegment segment = Burst();
  EXPECT_GT(UsualTorque({segment})[1], 1000);
  segment.lost = TimesOf(FindTorqueBursts(segment));
  EXPECT_NEAR(UsualTorque({segment})[0], 20, .01);
  EXPECT_NEAR(UsualTorque({segment})[1], 5, .01);
}

TEST(TorqueBursts, AreTold) {
  const Robot robot = SampleRobot("2R planar (horizontal)");
  EXPECT_THAT(TellTorqueBursts(robot, {Swing()}), IsEmpty());
  const std::vector<DataFinding> told =
      TellTorqueBursts(robot, {Swing(), Burst()});
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_THAT(told[0].evidence, HasSubstr("between 12 and 13 s"));
  EXPECT_THAT(told[0].evidence, HasSubstr(robot.links[1].joint.name));
}

}  // namespace
}  // namespace armcal
