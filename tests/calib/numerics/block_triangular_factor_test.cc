#include "calib/numerics/block_triangular_factor.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::block_triangular_factor_test {

using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

// Equations of a UR5 in random states, as they are and factored in one go.
class Factor : public testing::Test {
 protected:
  Factor()
      : parameters_(SampleRobot("UR5 6R"), ModelParameters::Options()),
        all_(parameters_) {
    Regressor regressor = parameters_.MakeRegressor();
    for (int k = 0; k < kRows; ++k) {
      MatrixXd U;
      regressor.Differential(UniformVector(&random_, 6, -3, 3),
                             UniformVector(&random_, 6, -2, 2),
                             UniformVector(&random_, 6, -5, 5), VectorXd(), &U);
      U_.push_back(U);
      Y_.push_back(UniformVector(&random_, 6, -10, 10));
      AddTo(k, 1, &all_);
    }
  }
  void AddTo(int k, double weight, BlockTriangularFactor* factor) const {
    for (int i = 0; i < 6; ++i) {
      factor->Add(i, U_[k].row(i), Y_[k][i], weight);
    }
  }
  // Joint i's equations in its own columns, the right side last.
  MatrixXd Stacked(int i, int rows = kRows) const {
    const std::vector<int>& columns = all_.columns(i);
    MatrixXd A(rows, columns.size() + 1);
    for (int k = 0; k < rows; ++k) {
      for (size_t c = 0; c < columns.size(); ++c) {
        A(k, c) = U_[k](i, columns[c]);
      }
      A(k, columns.size()) = Y_[k][i];
    }
    return A;
  }
  static MatrixXd Gram(const MatrixXd& R) { return R.transpose() * R; }
  static void ExpectSame(const BlockTriangularFactor& a, const MatrixXd& gram,
                         int i) {
    EXPECT_LE((Gram(a.Triangle(i)) - gram).norm(), 1e-13 * gram.norm()) << i;
  }

  static constexpr int kRows = 1100;
  std::mt19937_64 random_{4};
  ModelParameters parameters_;
  BlockTriangularFactor all_;
  std::vector<MatrixXd> U_;
  std::vector<VectorXd> Y_;
};

TEST_F(Factor, TriangleHasTheStackedEquationsGram) {
  for (int i = 0; i < 6; ++i) {
    ExpectSame(all_, Gram(Stacked(i)), i);
    EXPECT_EQ(all_.rows(i), kRows);
    EXPECT_TRUE(all_.Triangle(i).isUpperTriangular(0));
    EXPECT_EQ(all_.columns(i).front(), parameters_.block_begin(i));
    EXPECT_TRUE(std::is_sorted(all_.columns(i).begin(), all_.columns(i).end()));
  }
}

// 256 rows make a chunk; reading a triangle in between closes one early.
TEST_F(Factor, DoesNotDependOnChunks) {
  for (const int stop : {0, 1, 5, 255, 256, 257, 513}) {
    BlockTriangularFactor factor(parameters_);
    for (int k = 0; k < kRows; ++k) {
      if (k == stop || k == 2 * stop) {
        for (int i = 0; i < 6; ++i) factor.Triangle(i);
      }
      AddTo(k, 1, &factor);
    }
    for (int i = 0; i < 6; ++i) ExpectSame(factor, Gram(Stacked(i)), i);
  }
}

TEST_F(Factor, FewerRowsThanColumns) {
  for (const int rows : {0, 1, 3}) {
    BlockTriangularFactor factor(parameters_);
    for (int k = 0; k < rows; ++k) AddTo(k, 1, &factor);
    for (int i = 0; i < 6; ++i) {
      ExpectSame(factor, Gram(Stacked(i, rows)), i);
    }
  }
}

TEST_F(Factor, MergingIsAddingTheSameEquations) {
  BlockTriangularFactor merged(parameters_);
  for (int part = 0; part < 40; ++part) {  // enough to fill a chunk by merging
    BlockTriangularFactor factor(parameters_);
    for (int k = part; k < kRows; k += 40) AddTo(k, 1, &factor);
    for (int i = 0; i < 6; ++i) merged.Merge(factor, i);
  }
  for (int i = 0; i < 6; ++i) {
    ExpectSame(merged, Gram(Stacked(i)), i);
    EXPECT_EQ(merged.rows(i), kRows);
  }
}

TEST_F(Factor, MergesOneJointOnly) {
  BlockTriangularFactor merged(parameters_);
  merged.Merge(all_, 2);
  EXPECT_EQ(merged.rows(2), kRows);
  EXPECT_EQ(merged.rows(1), 0);
  EXPECT_EQ(merged.Triangle(1).norm(), 0);
  ExpectSame(merged, Gram(Stacked(2)), 2);
}

TEST_F(Factor, WeightsMultiplyEquations) {
  BlockTriangularFactor factor(parameters_);
  VectorXd weight(kRows);
  for (int k = 0; k < kRows; ++k) {
    weight[k] = Uniform(&random_, 0, 3);
    AddTo(k, weight[k], &factor);
  }
  for (int i = 0; i < 6; ++i) {
    ExpectSame(factor, Gram(weight.asDiagonal() * Stacked(i)), i);
  }
}

TEST_F(Factor, ResidualsAndRightSide) {
  const VectorXd rms = RightSideRms(all_);
  for (int trial = 0; trial < 5; ++trial) {
    const VectorXd x = UniformVector(&random_, parameters_.size(), -1, 1);
    for (int i = 0; i < 6; ++i) {
      double squares = 0, right = 0;
      for (int k = 0; k < kRows; ++k) {
        squares += std::pow(Y_[k][i] - U_[k].row(i).dot(x), 2);
        right += Y_[k][i] * Y_[k][i];
      }
      EXPECT_NEAR(all_.ResidualNorm(i, x), std::sqrt(squares),
                  1e-12 * std::sqrt(squares));
      EXPECT_NEAR(rms[i], std::sqrt(right / kRows), 1e-12);
    }
  }
}

// Normal equations would lose it all: at condition 1e7 their error is 1e-2.
TEST_F(Factor, KeepsTheAccuracyOfIllConditionedEquations) {
  const int m = static_cast<int>(all_.columns(5).size());
  const auto random_matrix = [&](int rows) {
    MatrixXd A(rows, m);
    for (double& x : A.reshaped()) x = Normal(&random_);
    return A;
  };
  const VectorXd scale = VectorXd::LinSpaced(m, 0, -7).unaryExpr(
      [](double e) { return std::pow(10, e); });
  const MatrixXd Q =
      Eigen::HouseholderQR<MatrixXd>(random_matrix(m)).householderQ();
  const MatrixXd A = random_matrix(400) * scale.asDiagonal() * Q;
  const VectorXd x = UniformVector(&random_, m, -1, 1);
  BlockTriangularFactor factor(parameters_);
  for (int k = 0; k < A.rows(); ++k) {
    RowVectorXd u = RowVectorXd::Zero(parameters_.size());
    for (int c = 0; c < m; ++c) u[factor.columns(5)[c]] = A(k, c);
    factor.Add(5, u, A.row(k).dot(x));
  }
  const MatrixXd R = factor.Triangle(5);
  const VectorXd solved =
      R.topLeftCorner(m, m).triangularView<Eigen::Upper>().solve(
          R.col(m).head(m));
  EXPECT_LT((solved - x).cwiseAbs().maxCoeff(), 1e-8);
}

}  // namespace armcal::block_triangular_factor_test
