#include "model/dynamics/torque_replay.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/dynamics/rigid_arm.h"
#include "model/plant/simbody_arm.h"
#include "tests/fixtures/exact_rollout.h"
#include "tests/fixtures/nonlinear_runs.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::torque_replay_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Law = CoulombTransition::Law;

// A block of 2 kg on a horizontal slide.
Robot Block() { return HorizontalSlide(2); }

// Pushed by a constant force from rest at 0.
Trajectory Pushed(double force, double duration) {
  Trajectory t;
  t.dt = .01;
  const int size = static_cast<int>(std::lround(duration / t.dt)) + 1;
  t.q = t.qd = t.qdd = MatrixXd::Zero(size, 1);
  t.tau = MatrixXd::Constant(size, 1, force);
  t.standstill.setConstant(size, false);
  t.core_end = size;
  return t;
}

// q, qd, c at the end.
VectorXd Replay(const Robot& robot, const CoulombTransition& transition,
                const Trajectory& trajectory) {
  RigidArm arm(robot);
  TorqueReplay replay(robot, {transition}, &arm);
  const MatrixXd states = replay.Follow(trajectory);
  const Integration run = replay.Run(trajectory, 0, trajectory.size() - 1,
                                     states.row(0), IntegrationOptions());
  EXPECT_TRUE(run.finished) << run.reason;
  return run.x.bottomRows<1>().transpose();
}

// m x'' = F - b x': v = F / b (1 - exp(-b t / m)); m includes the armature, and
// F is less by the offset.
TEST(TorqueReplay, ViscousFrictionOffsetAndArmature) {
  Robot robot = Block();
  Joint& joint = robot.links[0].joint;
  joint.viscous = 3;
  joint.offset = 1.5;
  joint.armature = .5;
  const double m = 2.5, F = 7 - 1.5, b = 3, t = 1;
  const VectorXd x = Replay(robot, {}, Pushed(7, t));
  const double decay = 1 - std::exp(-b * t / m);
  EXPECT_NEAR(x[1], F / b * decay, 1e-8);
  EXPECT_NEAR(x[0], F / b * (t - m / b * decay), 1e-8);
}

// Below its yield a Prandtl element is a spring: x = F w / C (1 - cos(W t)),
// W^2 = C / (m w), while x < w.
TEST(TorqueReplay, PresliddingIsASpring) {
  Robot robot = Block();
  robot.links[0].joint.coulomb = 5;
  const double w = .02, F = 1.5;
  const double omega = std::sqrt(5 / (2 * w)), t = .4;
  const VectorXd x = Replay(robot, {Law::kDisplacement, w}, Pushed(F, t));
  EXPECT_NEAR(x[0], F * w / 5 * (1 - std::cos(omega * t)), 1e-8);
  EXPECT_NEAR(x[2], x[0] / w, 1e-9);
}

// Beyond it: the energy F x = C (x - w / 2) + m v^2 / 2, c = 1.
TEST(TorqueReplay, YieldedFrictionTakesItsWork) {
  Robot robot = Block();
  robot.links[0].joint.coulomb = 5;
  const double w = .003;
  const VectorXd x = Replay(robot, {Law::kDisplacement, w}, Pushed(9, .5));
  ASSERT_GT(x[0], 10 * w);
  EXPECT_NEAR(9 * x[0], 5 * (x[0] - w / 2) + x[1] * x[1], 1e-6);
  EXPECT_NEAR(x[2], 1, 1e-6);
}

// Sliding steadily, friction is its tanh: F = C tanh(v / w).
TEST(TorqueReplay, VelocityLawSettles) {
  Robot robot = Block();
  robot.links[0].joint.coulomb = 5;
  const VectorXd x = Replay(robot, {Law::kVelocity, .3}, Pushed(3, 5));
  EXPECT_NEAR(x[1], .3 * std::atanh(3.0 / 5), 1e-7);
}

// Pushed away from a log that stays at 0: x = F / m t^2 / 2 passes 10 m at 2 s,
// and there it ends.
TEST(TorqueReplay, EndsWhereItIsLost) {
  const Robot robot = Block();
  RigidArm arm(robot);
  TorqueReplay replay(robot, {{}}, &arm);
  const Trajectory pushed = Pushed(10, 5);
  const Integration run = replay.Run(pushed, 0, pushed.size() - 1,
                                     VectorXd::Zero(1), IntegrationOptions());
  EXPECT_FALSE(run.finished);
  EXPECT_NEAR(static_cast<double>(run.x.rows()), 200, 1);
  EXPECT_LT(run.steps, 1000);
}

// The motion that a log's torque was made for, with all joint terms, comes
// back; from our engine and from Simbody.
TEST(TorqueReplay, ReturnsTheMotionOfItsTorque) {
  std::mt19937_64 random(2);
  const Robot truth = MakeArm("UR5 6R", .05, &random).truth;
  const Trajectory motion = MakeTrajectory(MoveArm(truth, 12, &random));
  RigidArm own(truth);
  SimbodyArm simbody(truth);
  for (ArmDynamics* engine :
       {static_cast<ArmDynamics*>(&own), static_cast<ArmDynamics*>(&simbody)}) {
    TorqueReplay replay(truth, std::vector<CoulombTransition>(6, kTransition),
                        engine);
    const MatrixXd states = replay.Follow(motion);
    const int first = 500, last = 550;  // half a second
    const Integration run = replay.Run(motion, first, last, states.row(first),
                                       IntegrationOptions());
    ASSERT_TRUE(run.finished) << run.reason;
    const MatrixXd error =
        run.x.leftCols(6) - motion.q.middleRows(first + 1, last - first);
    // What a torque that is linear between samples of 10 ms leaves.
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 2e-3);
    const MatrixXd travel = motion.q.row(last) - motion.q.row(first);
    EXPECT_GT(travel.cwiseAbs().maxCoeff(), .1);
  }
}

}  // namespace armcal::torque_replay_test
