#include "calib/linear/row_reduction.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "calib/numerics/thread_limit.h"
#include "problems/make_rows.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::row_reduction_test {

using Eigen::MatrixXd;

// A PUMA's motion of 6000 samples, with Coulomb friction and a standstill.
class Reduction : public testing::Test {
 protected:
  Reduction() : robot_(SampleRobot("PUMA560 6R")) {
    std::mt19937_64 random(3);
    SetRandomInertials(&random, &robot_);
    Log log = RecordMotion(RandomMultisine(&random, 6), 6, .001);
    AddTorque(robot_, &log);
    trajectory_ = MakeTrajectory(log);
    trajectory_.standstill.segment(2500, 300) = true;
    ModelParameters::Options options;
    options.joint_terms = {JointTerm::kViscous, JointTerm::kCoulomb};
    options.transitions.assign(6, {CoulombTransition()});
    parameters_.emplace(robot_, options);
  }
  static RowOptions Options(Identification identification) {
    RowOptions options;
    options.identification = identification;
    options.interval_s = .05;
    return options;
  }
  // Rows of a trajectory cut into `pieces`, each known with its surroundings.
  BlockTriangularFactor Reduce(const RowOptions& options, int threads,
                               int pieces) const {
    const ThreadLimit limit(threads);
    BlockTriangularFactor factor(*parameters_, RowsPerLeaf(options));
    MotionRegressor regressor(*parameters_);
    RowReduction reduction(*parameters_);
    for (int k = 0; k < pieces; ++k) {
      Trajectory piece = trajectory_;
      piece.core_begin = trajectory_.size() * k / pieces;
      piece.core_end = trajectory_.size() * (k + 1) / pieces;
      regressor.Enter(piece);
      reduction.Add(*MakeRows(piece, options, regressor), &factor);
    }
    return factor;
  }

  Robot robot_;
  Trajectory trajectory_;
  std::optional<ModelParameters> parameters_;
};

TEST_F(Reduction, AddsEveryRow) {
  for (const auto identification :
       {Identification::kWeak, Identification::kDifferential,
        Identification::kIntegral}) {
    const RowOptions options = Options(identification);
    const BlockTriangularFactor factor = Reduce(options, 2, 1);
    std::vector<MatrixXd> gram(6);
    for (int i = 0; i < 6; ++i) {
      const int size = static_cast<int>(factor.columns(i).size()) + 1;
      gram[i] = MatrixXd::Zero(size, size);
    }
    MotionRegressor regressor(*parameters_);
    long rows = 0;
    ForEachRow(trajectory_, options, &regressor, [&](const auto& row) {
      ++rows;
      for (int i = 0; i < 6; ++i) {
        Eigen::RowVectorXd u(gram[i].cols());
        u << row.U(i, factor.columns(i)), row.Y[i];
        gram[i] += u.transpose() * u;
      }
    });
    EXPECT_GT(rows, 30);
    for (int i = 0; i < 6; ++i) {
      EXPECT_EQ(factor.rows(i), rows);
      const MatrixXd R = factor.Triangle(i);
      EXPECT_LT((R.transpose() * R - gram[i]).norm(), 1e-13 * gram[i].norm());
    }
  }
}

TEST_F(Reduction, IsTheSameForAnyThreadsAndPieces) {
  for (const auto identification :
       {Identification::kWeak, Identification::kDifferential}) {
    const RowOptions options = Options(identification);
    const BlockTriangularFactor one = Reduce(options, 1, 1);
    for (const auto& [threads, pieces] :
         std::vector<std::pair<int, int>>{{2, 1}, {4, 1}, {1, 7}, {4, 50}}) {
      const BlockTriangularFactor other = Reduce(options, threads, pieces);
      for (int i = 0; i < 6; ++i) {
        ASSERT_EQ(other.rows(i), one.rows(i));
        ASSERT_EQ(other.Triangle(i), one.Triangle(i))
            << threads << " threads, " << pieces << " pieces";
      }
    }
  }
}

TEST_F(Reduction, ThreadsVisitRowsInOrder) {
  const ThreadLimit limit(4);
  EXPECT_EQ(ThreadLimit::Active(), 4);
  MotionRegressor regressor(*parameters_);
  regressor.Enter(trajectory_);
  const auto rows =
      MakeRows(trajectory_, Options(Identification::kDifferential), regressor);
  std::vector<IdentificationRow> expected;
  ForEachRow(*rows, regressor,
             [&](const auto& row) { expected.push_back(row); });
  size_t next = 0;
  ForEachRowOnThreads(*rows, regressor, [&](const auto& row) {
    ASSERT_LT(next, expected.size());
    EXPECT_EQ(row.time, expected[next].time);
    EXPECT_EQ(row.U, expected[next].U);
    EXPECT_EQ(row.Y, expected[next++].Y);
  });
  EXPECT_EQ(next, expected.size());
}

}  // namespace armcal::row_reduction_test
