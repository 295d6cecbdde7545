#include "model/dynamics/batch_forward_dynamics.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "model/dynamics/forward_dynamics.h"
#include "model/dynamics/inverse_dynamics.h"
#include "model/plant/simbody_arm.h"
#include "tests/fixtures/random_motion.h"

namespace armcal::batch_forward_dynamics_test {

using Eigen::Map;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd Row(const MatrixXd& M, int s, int n) {
  const VectorXd row = M.row(s);
  return Map<const MatrixXd>(row.data(), n, n);
}

double Condition(const MatrixXd& M) {
  const VectorXd d = Eigen::LDLT<MatrixXd>(M).vectorD();
  return d.maxCoeff() / d.minCoeff();
}

// The readable functions' values: joints of all kinds anywhere, 1 to 12 of
// them, counts that fill lanes and that do not, all instruction sets.
TEST(BatchForwardDynamics, IsForwardDynamics) {
  std::mt19937_64 random(6);
  for (int trial = 0; trial < 36; ++trial) {
    SCOPED_TRACE(trial);
    const int n = 1 + trial % 12, count = kCounts[trial % 4];
    Robot robot = ArmWithFrames(n, trial, &random);
    for (Link& link : robot.links) {
      link.joint.armature = trial % 2 * Uniform(&random, 0, .5);
    }
    const RandomMotion motion(&random, count, n, 0);
    for (const simd::Kernels* kernels : simd::AvailableKernels()) {
      SCOPED_TRACE(kernels->instruction_set);
      const BatchForwardDynamics dynamics(robot, *kernels);
      MatrixXd M, qdd;
      dynamics.MassMatrix(motion.q, &M);
      MatrixXd tau(count, n);
      for (int s = 0; s < count; ++s) {
        tau.row(s) = InverseDynamics(robot, motion.q.row(s), motion.qd.row(s),
                                     motion.qdd.row(s));
        for (int j = 0; j < n; ++j) {
          tau(s, j) += robot.links[j].joint.armature * motion.qdd(s, j);
        }
      }
      dynamics.Acceleration(motion.q, motion.qd, tau, &qdd);
      for (int s = 0; s < count; s += 1 + count / 20) {
        const MatrixXd expected = MassMatrix(robot, motion.q.row(s));
        EXPECT_LT((Row(M, s, n) - expected).norm(), 1e-13 * expected.norm());
        // Forward dynamics undo inverse dynamics but for rounding, which a
        // mass matrix magnifies by its condition.
        EXPECT_LT((qdd.row(s) - motion.qdd.row(s)).norm(),
                  1e-13 * (1 + Condition(expected)) * motion.qdd.row(s).norm());
      }
    }
  }
}

// The arm of a log: the identity to 1e-12, and Simbody's mass matrix.
TEST(BatchForwardDynamics, UndoesInverseDynamicsOfARealArm) {
  std::mt19937_64 random(7);
  Robot robot = SampleRobot("UR5 6R");
  SetRandomInertials(&random, &robot);
  const RandomMotion motion(&random, 200, 6, 0);
  MatrixXd tau(200, 6), qdd, M;
  for (int s = 0; s < 200; ++s) {
    tau.row(s) = InverseDynamics(robot, motion.q.row(s), motion.qd.row(s),
                                 motion.qdd.row(s));
  }
  SimbodyArm simbody(robot);
  for (const simd::Kernels* kernels : simd::AvailableKernels()) {
    const BatchForwardDynamics dynamics(robot, *kernels);
    dynamics.Acceleration(motion.q, motion.qd, tau, &qdd);
    EXPECT_LT((qdd - motion.qdd).norm(), 1e-12 * motion.qdd.norm());
    dynamics.MassMatrix(motion.q, &M);
    for (int s = 0; s < 200; s += 20) {
      const MatrixXd expected = simbody.MassMatrix(motion.q.row(s));
      EXPECT_LT((Row(M, s, 6) - expected).norm(), 1e-13 * expected.norm());
    }
  }
}

// A sample's bits are its own, whichever lane it is in, and no number stays
// where it is.
TEST(BatchForwardDynamics, SamplesDoNotSeeEachOther) {
  std::mt19937_64 random(8);
  const Robot robot = ArmWithFrames(5, 2, &random);
  RandomMotion motion(&random, 37, 5, 0);
  for (const simd::Kernels* kernels : simd::AvailableKernels()) {
    const BatchForwardDynamics dynamics(robot, *kernels);
    MatrixXd together, alone;
    motion.q(3, 1) = std::nan("");
    dynamics.Acceleration(motion.q, motion.qd, motion.qdd, &together);
    EXPECT_FALSE(together.row(3).allFinite());
    for (int s = 0; s < 37; ++s) {
      if (s == 3) continue;
      dynamics.Acceleration(motion.q.row(s), motion.qd.row(s),
                            motion.qdd.row(s), &alone);
      EXPECT_EQ(together.row(s), alone) << s;
    }
  }
}

TEST(BatchForwardDynamics, NothingToMoveIsNotANumber) {
  std::mt19937_64 random(9);
  Robot robot = ArmWithFrames(3, 0, &random);
  // Of a link that weighs next to nothing there is only rounding.
  robot.links[2].inertial = InertialParameters::FromVector(
      1e-18 * robot.links[2].inertial.ToVector());
  const MatrixXd zero = MatrixXd::Zero(4, 3);
  for (const simd::Kernels* kernels : simd::AvailableKernels()) {
    MatrixXd qdd;
    BatchForwardDynamics(robot, *kernels).Acceleration(zero, zero, zero, &qdd);
    EXPECT_TRUE(qdd.array().isNaN().all());
    robot.links[2].joint.armature = .1;
    BatchForwardDynamics(robot, *kernels).Acceleration(zero, zero, zero, &qdd);
    EXPECT_TRUE(qdd.allFinite());
    robot.links[2].joint.armature = 0;
  }
}

}  // namespace armcal::batch_forward_dynamics_test
