#include "model/dynamics/link_regressor.h"

#include <gtest/gtest.h>

#include "model/dynamics/inverse_dynamics.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::link_regressor_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd Stacked(const Robot& robot) {
  VectorXd V(10 * robot.num_joints());
  for (int i = 0; i < robot.num_joints(); ++i) {
    V.segment<10>(10 * i) = robot.links[i].inertial.ToVector();
  }
  return V;
}

// d/dt (P V) - D V by central differences against Newton-Euler.
TEST(LinkRegressor, GivesNewtonEulerTorques) {
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 60; ++trial) {
    const int n = 1 + trial % 7;
    Robot robot = RandomArm(n, &random);
    SetRandomInertials(&random, &robot);
    const VectorXd V = Stacked(robot);
    LinkRegressor regressor(robot);
    const VectorXd q = UniformVector(&random, n, -2, 2);
    const VectorXd qd = UniformVector(&random, n, -2, 2);
    const VectorXd qdd = UniformVector(&random, n, -2, 2);
    const double e = 1e-4;
    VectorXd before, after, PV, DV;
    regressor.Momentum(q - e * qd + e * e / 2 * qdd, qd - e * qdd, V, &before,
                       &DV);
    regressor.Momentum(q + e * qd + e * e / 2 * qdd, qd + e * qdd, V, &after,
                       &DV);
    regressor.Momentum(q, qd, V, &PV, &DV);
    const VectorXd tau = InverseDynamics(robot, q, qd, qdd);
    const double scale = std::max(1.0, tau.cwiseAbs().maxCoeff());
    EXPECT_LT(((after - before) / (2 * e) - DV - tau).norm(), 2e-6 * scale);
    MatrixXd P, D;
    regressor.Momentum(q, qd, &P, &D);
    EXPECT_LT((P * V - PV).norm(), 1e-12 * scale);
    EXPECT_LT((D * V - DV).norm(), 1e-12 * scale);
  }
}

}  // namespace armcal::link_regressor_test
