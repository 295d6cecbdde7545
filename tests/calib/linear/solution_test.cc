#include "calib/linear/solution.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::solution_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Equations of an arm in random states with noise of known size.
struct Equations {
  Equations(const std::string& robot_name, int rows_in,
            const VectorXd& sigma_in)
      : robot(SampleRobot(robot_name)),
        parameters(robot, ModelParameters::Options()),
        rows(rows_in),
        sigma(sigma_in) {
    std::mt19937_64 random(2);
    SetRandomInertials(&random, &robot);
    X = parameters.Values(robot);
    const int n = parameters.num_joints();
    Regressor regressor = parameters.MakeRegressor();
    U.resize(rows);
    for (MatrixXd& u : U) {
      regressor.Differential(UniformVector(&random, n, -3, 3),
                             UniformVector(&random, n, -2, 2),
                             UniformVector(&random, n, -5, 5), VectorXd(), &u);
    }
    Draw(1);
    reference = MakeReferenceScale(parameters, 1, .5, 1, ColumnRms(Y), X);
  }
  void Draw(int seed) {
    std::mt19937_64 random(seed);
    Y.resize(rows, parameters.num_joints());
    for (int k = 0; k < rows; ++k) Y.row(k) = U[k] * X;
    AddNoise(&random, sigma, &Y);
  }
  BlockTriangularFactor Factor() const {
    BlockTriangularFactor factor(parameters);
    for (int k = 0; k < rows; ++k) {
      for (int i = 0; i < parameters.num_joints(); ++i) {
        factor.Add(i, U[k].row(i), Y(k, i));
      }
    }
    return factor;
  }
  // Joint i's rows: columns [begin, begin + size).
  MatrixXd Rows(int i, int begin, int size) const {
    MatrixXd A(rows, size);
    for (int k = 0; k < rows; ++k) A.row(k) = U[k].block(i, begin, 1, size);
    return A;
  }
  // Least squares on all stacked rows, joint i's divided by noise[i].
  VectorXd Dense(const VectorXd& noise) const {
    const int n = parameters.num_joints(), m = parameters.size();
    MatrixXd A(rows * n, m);
    VectorXd y(rows * n);
    for (int i = 0; i < n; ++i) {
      A.middleRows(i * rows, rows) = Rows(i, 0, m) / noise[i];
      y.segment(i * rows, rows) = Y.col(i) / noise[i];
    }
    return A.completeOrthogonalDecomposition().solve(y);
  }
  // (2.28), literally.
  VectorXd Recursion() const {
    VectorXd x = VectorXd::Zero(parameters.size());
    for (int i = parameters.num_joints() - 1; i >= 0; --i) {
      const int begin = parameters.block_begin(i);
      const int size = parameters.block_size(i), end = begin + size;
      const int rest = parameters.size() - end;
      x.segment(begin, size) =
          Rows(i, begin, size)
              .completeOrthogonalDecomposition()
              .solve(Y.col(i) - Rows(i, end, rest) * x.tail(rest));
    }
    return x;
  }
  Identifiability Analyze() const {
    return AnalyzeIdentifiability(Factor(), parameters, sigma, reference);
  }

  Robot robot;
  ModelParameters parameters;
  int rows;
  VectorXd sigma, X;
  std::vector<MatrixXd> U;
  MatrixXd Y;
  ReferenceScale reference;
};

VectorXd UnequalNoise() {
  VectorXd sigma(6);
  sigma << .5, .8, .3, .01, .02, .004;
  return sigma;
}

void ExpectNear(const VectorXd& a, const VectorXd& b, double tolerance) {
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(),
            tolerance * std::max(1.0, b.cwiseAbs().maxCoeff()))
      << "difference " << (a - b).transpose();
}

TEST(LinearSolution, BatchAndWeightedAreDenseLeastSquares) {
  const Equations e("PUMA560 6R", 700, UnequalNoise());
  const BlockTriangularFactor factor = e.Factor();
  ExpectNear(SolveBatch(factor, e.reference).x, e.Dense(VectorXd::Ones(6)),
             1e-10);
  const LinearSolution weighted = SolveWeighted(factor, e.sigma, e.reference);
  ExpectNear(weighted.x, e.Dense(e.sigma), 1e-10);
  EXPECT_TRUE(weighted.solved);
  EXPECT_EQ(weighted.identifiable, std::vector<bool>(36, true));
}

TEST(LinearSolution, RecursionIsTheLiteralOne) {
  for (const char* name : {"PUMA560 6R", "UR5 6R"}) {
    const Equations e(name, 700, UnequalNoise());
    const LinearSolution solution = SolveRecursive(e.Factor(), e.Analyze());
    ASSERT_TRUE(solution.solved) << solution.refusal;
    ExpectNear(solution.x, e.Recursion(), 1e-10);
  }
}

// It is the limit of weights that fall steeply from the last joint to the
// first (a prototype at ratio 100: 8e-6).
TEST(LinearSolution, RecursionIsTheLimitOfWeights) {
  const Equations e("SCARA RRPR", 700, .01 * VectorXd::Ones(4));
  ExpectNear(SolveWeighted(e.Factor(), Eigen::Vector4d(1, 1e-2, 1e-4, 1e-6),
                           e.reference)
                 .x,
             SolveRecursive(e.Factor(), e.Analyze()).x, 1e-5);
}

// Standard deviations of all parameters over `runs` draws of the noise, over
// those the covariance claims; and the share of 95 % intervals with the truth.
template <class Solve>
void ExpectHonestCovariance(Equations e, int runs, const Solve& solve) {
  const int m = e.parameters.size();
  const MatrixXd claimed =
      solve(e.Factor()).IndependentCovariance(e.Factor(), e.sigma);
  VectorXd sum = VectorXd::Zero(m);
  MatrixXd outer = MatrixXd::Zero(m, m);
  for (int run = 0; run < runs; ++run) {
    e.Draw(1000 + run);
    const VectorXd error = solve(e.Factor()).x - e.X;
    sum += error;
    outer += error * error.transpose();
  }
  const VectorXd s = claimed.diagonal().cwiseSqrt();
  const VectorXd ratio = (outer.diagonal() / runs).cwiseSqrt().cwiseQuotient(s);
  EXPECT_LT((ratio.array() - 1).abs().maxCoeff(), .05) << ratio.transpose();
  EXPECT_LT((sum / runs).cwiseQuotient(s).cwiseAbs().maxCoeff(),
            4.5 / std::sqrt(runs));
  const MatrixXd scale = (s * s.transpose()).cwiseInverse();
  EXPECT_LT(scale.cwiseProduct(outer / runs - claimed).cwiseAbs().maxCoeff(),
            .1);
}

TEST(LinearSolution, CovarianceOfTheRecursionCarriesErrorsUp) {
  const Equations e("SCARA RRPR", 60, Eigen::Vector4d(.3, .3, .2, .1));
  const Identifiability identifiability = e.Analyze();
  ExpectHonestCovariance(e, 3000, [&](const BlockTriangularFactor& factor) {
    return SolveRecursive(factor, identifiability);
  });
}

TEST(LinearSolution, CovarianceOfWeightedAndBatch) {
  const Equations e("SCARA RRPR", 60, Eigen::Vector4d(.9, .3, .2, .01));
  ExpectHonestCovariance(e, 3000, [&](const BlockTriangularFactor& factor) {
    return SolveWeighted(factor, e.sigma, e.reference);
  });
  ExpectHonestCovariance(e, 3000, [&](const BlockTriangularFactor& factor) {
    return SolveBatch(factor, e.reference);
  });
}

// Weights found from the residuals cost a few percent at most.
TEST(LinearSolution, ReweightingReachesTheBoundAndTheNoise) {
  Equations e("PUMA560 6R", 400, UnequalNoise());
  const BlockTriangularFactor first = e.Factor();
  const VectorXd bound = SolveWeighted(first, e.sigma, e.reference)
                             .IndependentCovariance(first, e.sigma)
                             .diagonal()
                             .cwiseSqrt();
  double squares = 0;
  const int runs = 100;
  VectorXd noise_sum = VectorXd::Zero(6);
  for (int run = 0; run < runs; ++run) {
    e.Draw(run);
    VectorXd noise = ColumnRms(e.Y);
    const LinearSolution solution = SolveReweighted(
        e.Factor(), e.reference, std::vector<bool>(6, false), &noise);
    squares += (solution.x - e.X).cwiseQuotient(bound).squaredNorm() / 36;
    noise_sum += noise.cwiseQuotient(e.sigma);
  }
  EXPECT_NEAR(std::sqrt(squares / runs), 1, .05);
  // Every joint's estimate shares the correction for parameters spent.
  for (const double x : noise_sum / runs) EXPECT_NEAR(x, 1, .02) << noise_sum;
}

TEST(LinearSolution, ExcludedJointsKeepTheirNoise) {
  const Equations e("PUMA560 6R", 400, UnequalNoise());
  VectorXd noise = ColumnRms(e.Y);
  noise[2] = 0;
  const LinearSolution solution =
      SolveReweighted(e.Factor(), e.reference,
                      {false, false, true, false, false, false}, &noise);
  EXPECT_EQ(noise[2], 0);
  EXPECT_EQ(solution.weight[2], 0);
  EXPECT_GT(solution.weight[1], 0);
}

// Equations solved again with joint i's torques 3 % larger.
TEST(LinearSolution, TorqueScalesMoveTheEstimateAsSaid) {
  Equations e("UR5 6R", 200, VectorXd::Constant(6, .1));
  const VectorXd noise = VectorXd::LinSpaced(6, .1, .3);
  const LinearSolution solution = SolveWeighted(e.Factor(), noise, e.reference);
  EXPECT_LT((solution.by_scale.rowwise().sum() - solution.x).norm(),
            1e-9 * solution.x.norm());
  for (int i = 0; i < 6; ++i) {
    Equations scaled = e;
    scaled.Y.col(i) *= 1.03;
    const VectorXd moved =
        SolveWeighted(scaled.Factor(), noise, e.reference).x - solution.x;
    EXPECT_LT((moved - .03 * solution.by_scale.col(i)).norm(),
              1e-7 * solution.x.norm())
        << i;
  }
}

}  // namespace armcal::solution_test
