#include "model/dynamics/batch_torque_replay.h"

#include <gtest/gtest.h>

#include "model/dynamics/torque_replay.h"
#include "model/plant/simbody_arm.h"
#include "tests/fixtures/exact_rollout.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::batch_torque_replay_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Law = CoulombTransition::Law;

constexpr double kTolerance = 1e-6;

Robot RandomJoints(std::mt19937_64* random) {
  Robot robot = SampleRobot("UR5 6R");
  SetRandomInertials(random, &robot);
  for (Link& link : robot.links) {
    link.joint.viscous = Uniform(random, 1, 3);
    link.joint.coulomb = Uniform(random, 1, 3);
    link.joint.offset = Uniform(random, -1, 1);
    link.joint.armature = Uniform(random, .1, .5);
  }
  return robot;
}

Trajectory Recorded(const Robot& robot, std::mt19937_64* random) {
  Log log = RecordMotion(RandomMultisine(random, 6), 12, .01);
  AddTorque(robot, &log);
  Trajectory t;
  t.dt = .01;
  t.q = log.q;
  t.qd = log.qd;
  t.tau = log.tau;
  t.core_end = t.size();
  return t;
}

// Windows of a log are those that Simbody simulates in adaptive steps, with
// both laws of friction, in any place.
TEST(BatchTorqueReplay, IsTorqueReplay) {
  std::mt19937_64 random(2);
  const Robot truth = RandomJoints(&random);
  const Trajectory motion = Recorded(truth, &random);
  SimbodyArm simbody(truth);
  for (const Law law : {Law::kVelocity, Law::kDisplacement}) {
    const std::vector<CoulombTransition> transitions(
        6, {law, law == Law::kVelocity ? .02 : .003});
    TorqueReplay referee(truth, transitions, &simbody);
    BatchTorqueReplay replay(truth, transitions);
    const MatrixXd states = replay.Follow(motion);
    EXPECT_EQ(referee.Follow(motion), states);
    std::vector<int> first;
    for (int k = 100; k < 1000; k += 90) first.push_back(k);
    constexpr int kLength = 20;
    const auto windows = replay.Run(motion, first, kLength, states, kTolerance);
    ASSERT_EQ(windows.size(), first.size());
    IntegrationOptions exact;
    exact.relative = exact.absolute = 1e-10;
    for (size_t w = 0; w < first.size(); w += 3) {
      const Integration run = referee.Run(motion, first[w], first[w] + kLength,
                                          states.row(first[w]), exact);
      ASSERT_TRUE(run.finished && windows[w].finished);
      EXPECT_LT((windows[w].q - run.x.leftCols(6)).cwiseAbs().maxCoeff(),
                2 * kTolerance);
      EXPECT_LT((windows[w].qd - run.x.middleCols(6, 6)).cwiseAbs().maxCoeff(),
                200 * kTolerance);
    }
  }
}

// A slide pushed by a constant force from rest at 0, where the log stays.
Trajectory Pushed(double force, double duration) {
  Trajectory t;
  t.dt = .01;
  const int size = static_cast<int>(std::lround(duration / t.dt)) + 1;
  t.q = t.qd = t.qdd = MatrixXd::Zero(size, 1);
  t.tau = MatrixXd::Constant(size, 1, force);
  return t;
}

// x = F / m t^2 / 2 passes 10 m at 2 s; what starts as no number, at once.
TEST(BatchTorqueReplay, WhatIsLostIsNotFinished) {
  const BatchTorqueReplay replay(HorizontalSlide(2), {{}});
  Trajectory pushed = Pushed(10, 5);
  const MatrixXd none = MatrixXd::Zero(pushed.size(), 1);
  const auto short_ones = replay.Run(pushed, {0, 100}, 190, none, kTolerance);
  EXPECT_TRUE(short_ones[0].finished && short_ones[1].finished);
  EXPECT_NEAR(short_ones[0].q(189, 0), 5. / 2 * 1.9 * 1.9, 1e-9);
  EXPECT_FALSE(replay.Run(pushed, {0}, 210, none, kTolerance)[0].finished);
  pushed.q(100, 0) = std::nan("");
  const auto one = replay.Run(pushed, {0, 100, 200}, 50, none, kTolerance);
  EXPECT_TRUE(one[0].finished && one[2].finished);
  EXPECT_FALSE(one[1].finished);
  EXPECT_TRUE(replay.Run(pushed, {}, 50, none, kTolerance).empty());
}

// A light wrist with dry friction and no armature, which takes adaptive steps a
// million of them: it slides at F = C tanh(v / w) from the first steps on.
TEST(BatchTorqueReplay, LightJointsAreNotDear) {
  Robot robot = HorizontalSlide(1e-6);
  robot.links[0].joint.coulomb = 5;
  const BatchTorqueReplay replay(robot, {{Law::kVelocity, .02}});
  const Trajectory pushed = Pushed(3, 1);
  const MatrixXd none = MatrixXd::Zero(pushed.size(), 1);
  const double v = .02 * std::atanh(3. / 5);
  const auto window = replay.Run(pushed, {0}, 100, none, 1e-5)[0];
  ASSERT_TRUE(window.finished);
  EXPECT_NEAR(window.q(99, 0), v, 2e-5);
}

}  // namespace armcal::batch_torque_replay_test
