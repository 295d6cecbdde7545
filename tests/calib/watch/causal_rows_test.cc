#include "calib/watch/causal_rows.h"

#include <gmock/gmock.h>

#include "model/robot/kinematics.h"
#include "tests/calib/watch/watched_arm.h"

namespace armcal::causal_rows_test {

using Eigen::VectorXd;

// The torque is recursive Newton and Euler's, which shares no code with the
// regressor and needs the accelerations that the rows do without. What is left
// is what filters of positions do to a nonlinear arm, and at reversals.
TEST(CausalRows, ExplainTheTorqueWithoutAccelerations) {
  Robot robot = WatchedRobot();
  for (Link& link : robot.links) link.joint.coulomb = 0;
  const WatchModel model = WatchedModel(robot);
  const Log log = WatchedLog(robot, 1, 10, 0);
  CausalRows rows(model, 20);
  double left = 0, all = 0;
  for (int k = 0; k < log.size(); ++k) {
    if (!rows.Add(log.t[k], log.q.row(k), log.tau.row(k))) continue;
    left += (rows.y() - rows.U() * model.x).squaredNorm();
    all += rows.y().squaredNorm();
  }
  EXPECT_LT(std::sqrt(left / all), 1e-3);
}

// A wrench's work on a small motion is that of the torques it is balanced by.
TEST(CausalRows, WrenchColumnsAreMinusTheJacobian) {
  const Robot robot = WatchedRobot();
  const VectorXd q = VectorXd::LinSpaced(3, -.7, .9);
  const Eigen::MatrixXd columns = WrenchColumns(robot, q);
  constexpr double kStep = 1e-6;
  for (int j = 0; j < 3; ++j) {
    VectorXd moved = q;
    moved[j] += kStep;
    const Eigen::Isometry3d before = LinkPoses(robot, q).back();
    const Eigen::Isometry3d after = LinkPoses(robot, moved).back();
    const Eigen::Vector3d shift =
        (after.translation() - before.translation()) / kStep;
    const Eigen::AngleAxisd turn(after.linear() * before.linear().transpose());
    const Eigen::Vector3d rotation = turn.axis() * turn.angle() / kStep;
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(columns(j, k), -shift[k], 1e-5);
      EXPECT_NEAR(columns(j, 3 + k), -rotation[k], 1e-5);
    }
  }
}

TEST(CausalRows, TellWhereFrictionTurnsAndWhereAJointStands) {
  const Robot robot = WatchedRobot();
  const WatchModel model = WatchedModel(robot);
  CausalRows rows(model, 20);
  const VectorXd tau = VectorXd::Zero(3);
  for (int k = 0; k < 2000; ++k) rows.Add(.001 * k, VectorXd::Zero(3), tau);
  EXPECT_GT(rows.crossing().minCoeff(), .99);
  EXPECT_GT(rows.standing().minCoeff(), .99);
  for (int k = 2000; k < 4000; ++k) {
    rows.Add(.001 * k, VectorXd::Constant(3, .001 * (k - 2000)), tau);
  }
  EXPECT_LT(rows.crossing().maxCoeff(), .01);
  EXPECT_LT(rows.standing().maxCoeff(), .01);
}

}  // namespace armcal::causal_rows_test
