#include "calib/diagnose/select/pulse_events.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "calib/diagnose/data/motion_scale.h"
#include "calib/diagnose/data/thresholds.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::pulse_events_test {

constexpr double kDuration = 30, kStep = .01, kBandwidth = 10;

// Joints that turn forward all the time.
class PulseEvents : public testing::Test {
 protected:
  PulseEvents() {
    const int size = static_cast<int>(kDuration / kStep);
    GapSegment segment;
    segment.motion.dt = kStep;
    segment.motion.q.setZero(size, 2);
    segment.motion.qd.setOnes(size, 2);
    segment.motion.qdd.setZero(size, 2);
    segment.tau.setZero(size, 2);
    segment.still.setZero(size, 2);
    segments_ = {segment};
    rows_ = std::make_unique<GapRows>(segments_, kBandwidth);
  }

  // Of this torque on a joint, so many of a width each that all take `time`.
  static std::vector<GapEvent> Pulses(int joint, int count, double torque,
                                      double time) {
    std::vector<GapEvent> events;
    for (int k = 0; k < count; ++k) {
      GapEvent event;
      event.pulse = true;
      Contact& contact = event.contact;
      contact.joint = joint;
      contact.time = (k + .5) * kDuration / count;
      contact.torque = Eigen::Vector2d::Zero();
      contact.torque[joint] = torque;
      const double reach = Limits().event_reach * time / count / 2;
      contact.window = {contact.time - reach, contact.time + reach};
      events.push_back(event);
    }
    return events;
  }
  std::vector<int> JointsLeft(std::vector<GapEvent> events,
                              const std::vector<GapEvent>& more) const {
    events.insert(events.end(), more.begin(), more.end());
    DropSpoilt(*rows_, &events);
    std::vector<int> joints;
    for (const GapEvent& event : events) joints.push_back(event.contact.joint);
    return joints;
  }

  std::vector<GapSegment> segments_;
  std::unique_ptr<GapRows> rows_;
};

TEST_F(PulseEvents, FrictionThatComesAndGoesOnOneJointHidesNoPushOnAnother) {
  const std::vector<GapEvent> push = Pulses(0, 1, -30, .5);
  EXPECT_EQ(JointsLeft(push, Pulses(1, 6, -1, 3)), std::vector<int>{0});
  // Two that brake may be pushes, and so may six of which some help.
  EXPECT_EQ(JointsLeft(push, Pulses(1, 2, -1, 1)).size(), 3u);
  std::vector<GapEvent> both_ways = Pulses(1, 6, -1, 3);
  both_ways[3].contact.torque[1] = 1;
  EXPECT_EQ(JointsLeft(push, both_ways).size(), 7u);
}

TEST_F(PulseEvents, WhatLastsOnOneJointIsNoPushThere) {
  const std::vector<GapEvent> push = Pulses(0, 1, -30, .5);
  EXPECT_EQ(JointsLeft(push, Pulses(1, 3, 1, .4 * kDuration)),
            std::vector<int>{0});
}

TEST_F(PulseEvents, WhatAllJointsHaveMostOfTheTimeIsNoPush) {
  EXPECT_TRUE(JointsLeft(Pulses(0, 3, 1, .2 * kDuration),
                         Pulses(1, 3, 1, .2 * kDuration))
                  .empty());
}

// A long one may be what the model lacks, where short ones are pushes.
TEST_F(PulseEvents, LongOnesSpoilNoShortOnes) {
  const std::vector<GapEvent> shorts = Pulses(0, 3, 1, .2 * kDuration);
  std::vector<GapEvent> longs = Pulses(1, 2, 1, .2 * kDuration);
  for (GapEvent& event : longs) event.bank = 1;
  // One more of them fits into a third of the time, two do not.
  EXPECT_EQ(JointsLeft(longs, shorts), (std::vector<int>{0, 0, 0, 1}));
  // On a joint that short ones spoil they are looked at by themselves.
  EXPECT_EQ(JointsLeft(longs, Pulses(1, 3, 1, .4 * kDuration)),
            (std::vector<int>{1, 1}));
}

// A 2R arm that is known but for what models lack as a rule, a hundredth or two
// of 10 N m, and a log that has far less of that, as its reference has.
class PulsesOfAKnownArm : public testing::Test {
 protected:
  PulsesOfAKnownArm()
      : arm_("2R planar (vertical plane)", kDuration, kStep),
        baseline_(arm_.robot, {}, Eigen::VectorXd::Constant(2, 10)) {
    const std::vector<GapSegment> segments = {Recorded(0, 0)};
    const GapRows rows(segments, kBandwidth);
    baseline_.AddDiscrepancy(Discrepancy(
        arm_.robot, ScaleOf(baseline_, rows, RecordedTorques(baseline_, rows)),
        2, .02));
  }
  GapSegment Recorded(int log, double push) {
    Eigen::MatrixXd tau =
        RecordedTorque(arm_.robot, baseline_.transitions(), arm_.motion)
            .nominal();
    AddNoise(&random_, Eigen::VectorXd::Constant(2, 1e-3), &tau);
    for (int k = 0; k < tau.rows(); ++k) {
      tau(k, 1) -= push * std::exp(-std::pow((k * kStep - kPushed) / .2, 2));
    }
    GapSegment segment = MakeSegment(arm_.motion, tau);
    segment.log = log;
    return segment;
  }
  // Beside so many reference logs.
  std::vector<GapEvent> Found(double push, int references = 1) {
    std::vector<GapSegment> before;
    for (int k = 1; k <= references; ++k) before.push_back(Recorded(k, 0));
    GapRegression regression(baseline_, kBandwidth, {Recorded(0, push)},
                             before);
    regression.Refit();
    return FindPulses(regression, {});
  }

  static constexpr double kPushed = 14;  // s
  EffectArm arm_;
  GapBaseline baseline_;
  std::mt19937_64 random_{5};
};

TEST_F(PulsesOfAKnownArm, APushIsFound) {
  const std::vector<GapEvent> events = Found(4);
  ASSERT_FALSE(events.empty());
  EXPECT_NEAR(events[0].contact.time, kPushed, .1);
  EXPECT_NEAR(events[0].contact.torque[1], 4, 1);
}

// It is far more than the log's noise and than any pulse of the reference, and
// far less than what the model may lack: of how logs differ, two references
// tell, and one does not.
TEST_F(PulsesOfAKnownArm, WhatAnyModelLacksIsNoPush) {
  EXPECT_TRUE(Found(.03).empty());
  EXPECT_FALSE(Found(.03, 2).empty());
}

}  // namespace armcal::pulse_events_test
