#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "model/dynamics/inverse_dynamics.h"
#include "tests/fixtures/calibrate_logs.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::passive_joint_test {

using Eigen::VectorXd;

// A 2R arm of which joint 2 has no motor: it moves as joint 1 makes it.
Robot TwoLinks() {
  std::mt19937_64 random(43);
  Robot robot = SampleRobot("2R planar (vertical plane)");
  SetRandomInertials(&random, &robot);
  for (Link& link : robot.links) link.joint.viscous = .2;
  return robot;
}

double FreeAcceleration(const Robot& robot, const Eigen::Vector2d& q,
                        const Eigen::Vector2d& qd, double qdd1) {
  const auto torque = [&](double qdd2) {
    return InverseDynamics(robot, q, qd, Eigen::Vector2d(qdd1, qdd2))[1] +
           robot.links[1].joint.viscous * qd[1];
  };
  return -torque(0) / (torque(1) - torque(0));
}

Log SwingFreely(const Robot& robot, int seed, double noise = .005) {
  constexpr double kStep = .005;
  std::mt19937_64 random(seed);
  const Multisine motion = RandomMultisine(&random, 2);
  const Log fine = RecordMotion(motion, 20 + kStep, kStep / 2);
  Log log = RecordMotion(motion, 20, kStep);
  Eigen::Vector2d state(.5, 0);  // q2, qd2
  const auto rate = [&](int k, const Eigen::Vector2d& s) {
    return Eigen::Vector2d(
        s[1], FreeAcceleration(robot, {fine.q(k, 0), s[0]},
                               {fine.qd(k, 0), s[1]}, fine.qdd(k, 0)));
  };
  for (int k = 0; k < log.size(); ++k) {  // Runge and Kutta
    const Eigen::Vector2d a = rate(2 * k, state);
    log.q(k, 1) = state[0];
    log.qd(k, 1) = state[1];
    log.qdd(k, 1) = a[1];
    const Eigen::Vector2d b = rate(2 * k + 1, state + kStep / 2 * a);
    const Eigen::Vector2d c = rate(2 * k + 1, state + kStep / 2 * b);
    const Eigen::Vector2d d = rate(2 * k + 2, state + kStep * c);
    state += kStep / 6 * (a + 2 * b + 2 * c + d);
  }
  AddTorque(robot, &log);
  log.tau.col(1).setZero();
  AddNoise(&random, Eigen::Vector2d(.05, noise), &log.tau);
  return log;
}

LinearCalibrationOptions ViscousOnly() {
  LinearCalibrationOptions options;
  options.joint_terms = {JointTerm::kViscous};
  options.bandwidth_hz = 0;
  return options;
}

// The passive joint's equation is homogeneous: the scale must come from joint
// 1's, and the parameters must not shrink to fit it.
void ExpectFound(const Robot& robot, const LinearCalibration& result) {
  ASSERT_TRUE(result.solved) << result.reason;
  const VectorXd X = result.parameters.Values(robot);
  for (int k = 0; k < X.size(); ++k) {
    std::printf("%-10s truth %8.5f error %8.5f stddev %8.5f\n",
                result.parameters.parameters()[k].name.c_str(), X[k],
                result.x[k] - X[k], result.stddev[k]);
    EXPECT_LT(std::abs(result.x[k] - X[k]), 5 * result.stddev[k]);
    EXPECT_LT(result.stddev[k], .05 * X.cwiseAbs().maxCoeff());
  }
  ASSERT_EQ(result.unpowered.size(), 1u);
  EXPECT_EQ(result.unpowered[0].log, 0);
  EXPECT_EQ(result.unpowered[0].joint, 1);
}

TEST(PassiveJoint, ParametersDoNotCollapse) {
  const Robot robot = TwoLinks();
  ExpectFound(robot,
              CalibrateLogs(robot, {SwingFreely(robot, 1)}, ViscousOnly()));
}

// A robot file without inertia cannot tell small torques from none; but it can
// where there is none at all.
TEST(PassiveJoint, ParametersDoNotCollapseWithoutNominalInertia) {
  const Robot robot = TwoLinks();
  ExpectFound(robot, CalibrateLogs(SampleRobot("2R planar (vertical plane)"),
                                   {SwingFreely(robot, 1, 0)}, ViscousOnly()));
}

// A joint whose torque is nothing but noise must not hide what the others see.
TEST(PassiveJoint, NoiseForTorqueDoesNotHideTheArm) {
  const Robot robot = TwoLinks();
  const LinearCalibration result =
      CalibrateLogs(SampleRobot("2R planar (vertical plane)"),
                    {SwingFreely(robot, 1, .05)}, ViscousOnly());
  const VectorXd X = result.parameters.Values(robot);
  EXPECT_GE(result.identifiability.batch_rank, X.size() - 1);
  for (int k = 0; k + 1 < X.size(); ++k) {
    EXPECT_LT(std::abs(result.x[k] - X[k]), 5 * result.stddev[k]) << k;
    EXPECT_LT(result.stddev[k], .01) << k;
  }
}

// Free in the second of three logs: that equation is left out and named.
TEST(PassiveJoint, FreeSwingInOneLogIsNamed) {
  const Robot robot = TwoLinks();
  std::mt19937_64 random(44);
  std::vector<Log> logs;
  for (int k = 0; k < 3; ++k) {
    logs.push_back(RecordMotion(RandomMultisine(&random, 2), 10, .005));
    AddTorque(robot, &logs.back());
    AddNoise(&random, Eigen::Vector2d(.05, .05), &logs.back().tau);
  }
  logs[1] = SwingFreely(robot, 2);
  const LinearCalibration result = CalibrateLogs(robot, logs, ViscousOnly());
  ASSERT_EQ(result.unpowered.size(), 1u);
  EXPECT_EQ(result.unpowered[0].log, 1);
  EXPECT_EQ(result.unpowered[0].joint, 1);
  EXPECT_LT(result.unpowered[0].torque_rms, .01);
  const VectorXd z =
      (result.x - result.parameters.Values(robot)).cwiseQuotient(result.stddev);
  EXPECT_LT(z.cwiseAbs().maxCoeff(), 5) << z.transpose();
}

TEST(PassiveJoint, NoTorqueAtAllIsAResult) {
  const Robot robot = TwoLinks();
  Log log = SwingFreely(robot, 1);
  log.tau.setZero();
  const LinearCalibration result = CalibrateLogs(robot, {log}, ViscousOnly());
  EXPECT_FALSE(result.solved);
  EXPECT_EQ(result.reason, "the torque in the logs is zero throughout");
}

}  // namespace armcal::passive_joint_test
