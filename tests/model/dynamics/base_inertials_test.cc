#include "model/dynamics/base_inertials.h"

#include <gtest/gtest.h>

#include "model/dynamics/batch_regressor.h"
#include "model/dynamics/link_regressor.h"
#include "tests/fixtures/random_motion.h"

namespace armcal::base_inertials_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<Robot> Robots(std::mt19937_64* random) {
  std::vector<Robot> robots;
  for (const std::string& name : SampleRobotNames()) {
    robots.push_back(SampleRobot(name));
  }
  for (int trial = 0; trial < 12; ++trial) {
    robots.push_back(ArmWithFrames(1 + trial % 9, trial, random));
  }
  return robots;
}

// At other states than those they were found at, by other code.
TEST(BaseInertials, AllColumnsFollowFromThem) {
  std::mt19937_64 random(11);
  for (const Robot& robot : Robots(&random)) {
    const int n = robot.num_joints();
    SCOPED_TRACE(robot.name + " of " + std::to_string(n));
    const BaseInertials base(robot);
    LinkRegressor regressor(robot);
    for (int s = 0; s < 5; ++s) {
      const VectorXd q = UniformVector(&random, n, -3, 3),
                     qd = UniformVector(&random, n, -4, 4);
      MatrixXd P, D;
      regressor.Momentum(q, qd, &P, &D);
      for (const MatrixXd& A : {P, D}) {
        const MatrixXd chosen = A(Eigen::all, base.columns);
        EXPECT_LT((chosen * base.combinations - A).norm(), 1e-12 * A.norm());
      }
    }
  }
}

// As many as the literature has: 36 of a PUMA and of a UR (Gautier and Khalil
// 1990), 43 of a Panda (Gaz et al. 2019).
TEST(BaseInertials, AreAsManyAsPublished) {
  EXPECT_EQ(BaseInertials(SampleRobot("PUMA560 6R")).columns.size(), 36u);
  EXPECT_EQ(BaseInertials(SampleRobot("UR5 6R")).columns.size(), 36u);
  EXPECT_EQ(BaseInertials(SampleRobot("Panda 7R")).columns.size(), 43u);
  EXPECT_EQ(BaseInertials(SampleRobot("2R planar (horizontal)")).columns.size(),
            4u);
}

// Joint i's are those of links i to n, and nothing beside them is written.
TEST(BaseInertials, HaveARegressorOfTheirOwn) {
  std::mt19937_64 random(13);
  const Robot robot = ArmWithFrames(5, 2, &random);
  const std::vector<int> columns = BaseInertials(robot).columns;
  const int count = 11;
  const RandomMotion motion(&random, count, 5, 0);
  for (const simd::Kernels* kernels : simd::AvailableKernels()) {
    SCOPED_TRACE(kernels->instruction_set);
    const BatchRegressor all(robot, *kernels), some(robot, columns, *kernels);
    std::vector<MatrixXd> of_all, of_some;
    std::vector<double*> U_all, U_some;
    for (int i = 0; i < 5; ++i) {
      of_all.push_back(MatrixXd::Zero(count, all.row_size(i)));
      of_some.push_back(MatrixXd::Constant(count, some.row_size(i) + 1, 12345));
      U_all.push_back(of_all[i].data());
      U_some.push_back(of_some[i].data());
    }
    all.Differential(motion.columns(), count, U_all.data(), count);
    some.Differential(motion.columns(), count, U_some.data(), count);
    for (int i = 0; i < 5; ++i) {
      int next = 0;
      for (const int c : columns) {
        if (c < 10 * i) continue;
        const VectorXd expected = of_all[i].col(c - 10 * i);
        EXPECT_LT((of_some[i].col(next++) - expected).norm(),
                  1e-14 * (1 + expected.norm()));
      }
      ASSERT_EQ(next, some.row_size(i));
      EXPECT_TRUE((of_some[i].col(next).array() == 12345).all());
    }
  }
}

// A near miss of parallel axes is no reason for large combinations.
TEST(BaseInertials, HoldWhereAxesAreNearlyParallel) {
  std::mt19937_64 random(12);
  for (const double angle : {1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2}) {
    SCOPED_TRACE(angle);
    Robot robot = SampleRobot("UR5 6R");
    robot.links[1].X_ML.rotate(
        Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()));
    const BaseInertials base(robot);
    LinkRegressor regressor(robot);
    MatrixXd P, D;
    regressor.Momentum(UniformVector(&random, 6, -3, 3),
                       UniformVector(&random, 6, -4, 4), &P, &D);
    const MatrixXd chosen = D(Eigen::all, base.columns);
    EXPECT_LT((chosen * base.combinations - D).norm(), 1e-10 * D.norm());
  }
}

}  // namespace armcal::base_inertials_test
