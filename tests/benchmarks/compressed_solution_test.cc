#include "tests/benchmarks/compressed_solution.h"

#include <gtest/gtest.h>

#include <vector>

#include "calib/numerics/thread_limit.h"
#include "model/simd/kernels.h"
#include "tests/benchmarks/six_axis_blocks.h"
#include "tests/fixtures/random_motion.h"

namespace armcal::compressed_solution_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kJoints = SixAxisProblem::kJoints;
constexpr int kInertial = SixAxisProblem::kInertial;
constexpr int kGeometric = SixAxisProblem::kGeometric;
constexpr int kSize = kInertial + kGeometric;

struct PerSample {
  PerSample(const SixAxisProblem& from, const VectorXd& start)
      : inertial(start.head(kInertial)), geometric(start.tail(kGeometric)) {
    for (const SixAxisSample& sample : from.samples) {
      problem.AddResidualBlock(new SixAxisBlock(new SixAxisResidual{sample}),
                               nullptr, inertial.data(), geometric.data());
    }
    AddSixAxisPriors(from, inertial.data(), geometric.data(), &problem);
  }
  double Solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.function_tolerance = options.gradient_tolerance = 1e-15;
    options.parameter_tolerance = 1e-13;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    EXPECT_TRUE(summary.IsSolutionUsable());
    return summary.final_cost;
  }
  MatrixXd Covariance() {
    ceres::Covariance::Options options;
    options.algorithm_type = ceres::SPARSE_QR;
    ceres::Covariance covariance(options);
    const std::vector<const double*> blocks = {inertial.data(),
                                               geometric.data()};
    EXPECT_TRUE(covariance.Compute(blocks, &problem));
    Eigen::Matrix<double, kSize, kSize, Eigen::RowMajor> C;
    EXPECT_TRUE(covariance.GetCovarianceMatrix(blocks, C.data()));
    return C;
  }
  VectorXd x() const {
    VectorXd x(kSize);
    x << inertial, geometric;
    return x;
  }

  VectorXd inertial, geometric;
  ceres::Problem problem;
};

VectorXd Start(const CompressedSolution& solution) {
  std::mt19937_64 random(1);
  return solution.x() + UniformVector(&random, kSize, -.01, .01);
}

TEST(CompressedSolution, IsCeres) {
  const SixAxisProblem problem(60);
  CompressedSolution solution(problem);
  const VectorXd start = Start(solution);
  PerSample ceres(problem, start);
  const double cost = ceres.Solve();
  solution.Start(start);
  EXPECT_GT(solution.cost(), 1.1 * cost);
  int iterations = 0;
  while (solution.Iterate()) ASSERT_LT(++iterations, 20);
  EXPECT_NEAR(solution.cost(), cost, 1e-8 * cost);
  const MatrixXd expected = ceres.Covariance();
  const VectorXd stddev = expected.diagonal().cwiseSqrt();
  const auto relative = stddev.cwiseInverse().asDiagonal();
  EXPECT_LT((relative * (solution.x() - ceres.x())).cwiseAbs().maxCoeff(),
            1e-5);
  const MatrixXd error =
      relative * (solution.Covariance() - expected) * relative;
  EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-8);
}

// The Jacobian of a block, in lanes and sample by sample.
TEST(CompressedSolution, JacobianIsCeres) {
  const SixAxisProblem problem(11);
  const CompressedSolution solution(problem);
  const Trajectory& t = solution.trajectory();
  const VectorXd x = solution.x();
  for (const simd::Kernels* kernels : simd::AvailableKernels()) {
    const GeometryJacobian jacobian(solution.WithInertia(x),
                                    solution.Geometry(x), solution.refined(),
                                    *kernels);
    std::vector<MatrixXd> rows(kJoints, MatrixXd(t.size(), kGeometric));
    std::vector<double*> out;
    for (MatrixXd& row : rows) out.push_back(row.data());
    jacobian.Torque({t.q, t.qd, t.qdd, {}}, t.size(), out.data(), t.size());
    for (int k = 0; k < t.size(); ++k) {
      const double* parameters[] = {x.data(), x.data() + kInertial};
      double residual[kJoints];
      Eigen::Matrix<double, kJoints, kGeometric, Eigen::RowMajor> expected;
      double* jacobians[] = {nullptr, expected.data()};
      SixAxisBlock(new SixAxisResidual{problem.samples[k]})
          .Evaluate(parameters, residual, jacobians);
      const MatrixXd one =
          jacobian.Torque(t.q.row(k), t.qd.row(k), t.qdd.row(k));
      EXPECT_LT((one - expected).norm(), 1e-13 * expected.norm());
      for (int j = 0; j < kJoints; ++j) {
        EXPECT_LT((rows[j].row(k) - expected.row(j)).norm(),
                  1e-13 * expected.norm());
      }
    }
  }
}

TEST(CompressedSolution, IsTheSameForAnyNumberOfThreads) {
  const SixAxisProblem problem(5000);
  std::vector<VectorXd> found;
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    CompressedSolution solution(problem);
    solution.Start(Start(solution));
    ASSERT_TRUE(solution.Iterate());
    ASSERT_TRUE(solution.Iterate());
    found.push_back(solution.x());
    EXPECT_EQ(found.back(), found.front()) << threads;
  }
}

}  // namespace armcal::compressed_solution_test
