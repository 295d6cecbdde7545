#include "calib/linear/robust_reduction.h"

#include <gtest/gtest.h>

#include <numeric>

#include "calib/numerics/thread_limit.h"
#include "problems/link_functions.h"
#include "problems/make_rows.h"
#include "problems/weak_rows.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::robust_reduction_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Weak rows of a PUMA whose torque is that of an arm that is a little
// different, with gross errors.
struct Case {
  Case() : robot(SampleRobot("PUMA560 6R")) {
    std::mt19937_64 random(3);
    SetRandomInertials(&random, &robot);
    Log log = RecordMotion(RandomMultisine(&random, 6), 20, .004);
    AddTorque(robot, &log);
    AddNoise(&random, .02 * ColumnRms(log.tau), &log.tau);
    log.tau.middleRows(1000, 300).array() += 50;
    trajectory = MakeTrajectory(log);
    const ArmGeometry geometry(robot);
    std::vector<int> refined(geometry.size() - 12);
    std::iota(refined.begin(), refined.end(), 6);
    functions.emplace(robot, std::vector<JointTermColumn>(), geometry, refined);
    functions->Enter(trajectory);
    rows.emplace(trajectory, RowOptions(), *functions);
    at.x.resize(functions->size());
    at.x << StackInertials(robot), geometry.Values()(refined);
    at.nonlinear = static_cast<int>(refined.size());
    at.noise = VectorXd::LinSpaced(6, .5, 2);
    at.loss = RobustLoss::kHuber;
  }
  RobustReduction Reduce(const std::vector<bool>& used) const {
    RobustReduction reduction(at, *functions, 8);
    reduction.Add(*rows, used);
    return reduction;
  }
  Robot robot;
  Trajectory trajectory;
  std::optional<LinkFunctions> functions;
  std::optional<WeakRows> rows;
  RobustReduction::Point at;
};

// Row by row: y less what is linear is the residual; what is not is y's.
TEST(RobustReduction, IsOfTheWeightedEquations) {
  const Case c;
  const std::vector<bool> used = {true, true, false, true, true, true};
  const Eigen::Index size = c.at.x.size(), linear = size - c.at.nonlinear;
  MatrixXd gram = MatrixXd::Zero(size + 1, size + 1);
  std::vector<ResidualSpread> spreads(6);
  int doubted = 0;
  ForEachRow(*c.rows, *c.functions, [&](const IdentificationRow& row) {
    for (int i = 0; i < 6; ++i) {
      if (!used[i]) continue;
      const double r =
          (row.Y[i] - row.U.row(i).head(linear).dot(c.at.x.head(linear))) /
          c.at.noise[i];
      const double weight = EvaluateLoss(RobustLoss::kHuber, r).weight;
      doubted += weight < 1;
      VectorXd equation(size + 1);
      equation << row.U.row(i).transpose(),
          row.Y[i] + row.U.row(i)
                         .tail(c.at.nonlinear)
                         .dot(c.at.x.tail(c.at.nonlinear));
      equation /= c.at.noise[i];
      gram += weight * equation * equation.transpose();
      spreads[i].Add(r);
    }
  });
  ASSERT_GT(doubted, 10);
  const RobustReduction reduction = c.Reduce(used);
  const MatrixXd R = reduction.Triangle();
  EXPECT_LT((R.transpose() * R - gram).norm(), 1e-12 * gram.norm());
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(reduction.spread(i).count(), spreads[i].count());
    EXPECT_NEAR(reduction.spread(i).Value(), spreads[i].Value(), 1e-9);
  }
}

TEST(RobustReduction, IsTheSameForAnyNumberOfThreads) {
  const Case c;
  const std::vector<bool> used(6, true);
  const auto reduce = [&](int threads) {
    const ThreadLimit limit(threads);
    return c.Reduce(used);
  };
  const RobustReduction one = reduce(1);
  for (const int threads : {2, 4}) {
    const RobustReduction other = reduce(threads);
    EXPECT_EQ(other.Triangle(), one.Triangle());
    for (int i = 0; i < 6; ++i) {
      EXPECT_EQ(other.spread(i).Value(), one.spread(i).Value());
    }
  }
}

}  // namespace armcal::robust_reduction_test
