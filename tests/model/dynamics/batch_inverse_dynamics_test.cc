#include "model/dynamics/batch_inverse_dynamics.h"

#include <gtest/gtest.h>

#include "model/dynamics/inverse_dynamics.h"
#include "tests/fixtures/random_motion.h"

namespace armcal::batch_inverse_dynamics_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(BatchInverseDynamics, IsInverseDynamics) {
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 36; ++trial) {
    SCOPED_TRACE(trial);
    const int n = 1 + trial % 12, count = kCounts[trial % 4];
    const Robot robot = ArmWithFrames(n, trial, &random);
    const RandomMotion motion(&random, count, n, 0);
    for (const simd::Kernels* kernels : simd::AvailableKernels()) {
      SCOPED_TRACE(kernels->instruction_set);
      MatrixXd tau = MatrixXd::Constant(count + 1, n, 12345);
      std::vector<double*> columns;
      for (int j = 0; j < n; ++j) columns.push_back(tau.col(j).data());
      BatchInverseDynamics(robot, *kernels)
          .Torque(motion.columns(), count, columns.data());
      EXPECT_TRUE((tau.row(count).array() == 12345).all());
      for (int s = 0; s < count; s += 1 + count / 20) {
        const VectorXd expected = InverseDynamics(
            robot, motion.q.row(s), motion.qd.row(s), motion.qdd.row(s));
        EXPECT_LT((tau.row(s).transpose() - expected).norm(),
                  1e-12 * expected.norm());
      }
    }
  }
}

}  // namespace armcal::batch_inverse_dynamics_test
