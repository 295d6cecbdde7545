#include "calib/numerics/triangular_factor.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/fixtures/sample_robots.h"

namespace armcal::triangular_factor_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd RandomRows(int rows, int columns, std::mt19937_64* random) {
  MatrixXd A(rows, columns);
  for (double& x : A.reshaped()) x = Uniform(random, -1, 1);
  return A;
}

// R'R = [A y]'[A y], R upper triangular.
void ExpectFactorOf(const TriangularFactor& factor, const MatrixXd& Ay) {
  const MatrixXd R = factor.Triangle();
  ASSERT_EQ(R.rows(), Ay.cols());
  ASSERT_EQ(R.cols(), Ay.cols());
  EXPECT_TRUE(R.isUpperTriangular(0));
  const MatrixXd normal = Ay.transpose() * Ay;
  EXPECT_LT((R.transpose() * R - normal).norm(), 1e-12 * (1 + normal.norm()));
  EXPECT_EQ(factor.rows(), Ay.rows());
}

void AddRows(const MatrixXd& Ay, TriangularFactor* factor) {
  const Eigen::Index n = Ay.cols() - 1;
  for (Eigen::Index k = 0; k < Ay.rows(); ++k) {
    factor->Add(Ay.row(k).head(n), Ay(k, n), 1);
  }
}

TEST(TriangularFactor, OfAnyNumberOfRows) {
  std::mt19937_64 random(1);
  for (const int columns : {1, 4, 30}) {
    for (const int rows : {0, 1, 3, 255, 256, 257, 1000}) {
      const MatrixXd Ay = RandomRows(rows, columns + 1, &random);
      TriangularFactor factor(columns);
      AddRows(Ay, &factor);
      ExpectFactorOf(factor, Ay);
      ExpectFactorOf(factor, Ay);  // reading changes nothing
    }
  }
}

TEST(TriangularFactor, WeightsRows) {
  std::mt19937_64 random(2);
  MatrixXd Ay = RandomRows(400, 6, &random);
  TriangularFactor factor(5);
  for (int k = 0; k < Ay.rows(); ++k) {
    const double weight = Uniform(&random, 0, 3);
    factor.Add(Ay.row(k).head(5), Ay(k, 5), weight);
    Ay.row(k) *= weight;
  }
  ExpectFactorOf(factor, Ay);
}

TEST(TriangularFactor, ReadsBetweenRowsAndMerges) {
  std::mt19937_64 random(3);
  const MatrixXd Ay = RandomRows(900, 8, &random);
  TriangularFactor first(7), second(7), empty(7);
  AddRows(Ay.topRows(100), &first);
  ExpectFactorOf(first, Ay.topRows(100));
  AddRows(Ay.middleRows(100, 410), &first);
  ExpectFactorOf(first, Ay.topRows(510));
  AddRows(Ay.bottomRows(390), &second);
  first.Merge(second);
  ExpectFactorOf(first, Ay);
  first.Merge(empty);
  ExpectFactorOf(first, Ay);
  empty.Merge(first);
  ExpectFactorOf(empty, Ay);
}

// Rows are numbered: in whatever pieces they come, and whether a triangle is
// read in between, the factor is the same bits.
TEST(TriangularFactor, IsTheSameForAnyPieces) {
  std::mt19937_64 random(5);
  const int columns = 11, rows = 5000;
  const MatrixXd Ay = RandomRows(rows, columns + 1, &random);
  for (const long leaf_rows : {32L, 300L, TriangularFactor::kLeafRows}) {
    TriangularFactor singly(columns, leaf_rows);
    AddRows(Ay, &singly);
    for (const int piece : {1, 7, 1000, 4999, rows}) {
      TriangularFactor factor(columns, leaf_rows);
      for (int begin = 0; begin < rows; begin += piece) {
        factor.AddRows(Ay.data() + begin, rows, std::min(piece, rows - begin));
        if (begin % 3 == 0) factor.Triangle();
      }
      EXPECT_EQ(factor.rows(), rows);
      EXPECT_EQ(factor.Triangle(), singly.Triangle()) << leaf_rows;
    }
  }
}

// As by several threads: each leaf elsewhere, put back in order.
TEST(TriangularFactor, LeavesMayBeReducedElsewhere) {
  std::mt19937_64 random(6);
  const int columns = 5;
  const long leaf_rows = 300, rows = 1000;
  const MatrixXd Ay = RandomRows(rows, columns + 1, &random);
  TriangularFactor whole(columns, leaf_rows), factor(columns, leaf_rows);
  AddRows(Ay, &whole);
  AddRows(Ay.topRows(100), &factor);
  LeafFactor leaf(columns);
  factor.TakeLeaf(&leaf);
  EXPECT_EQ(leaf.rows(), 100);
  for (long row = 100; row < rows;) {
    const long end = std::min(rows, row + leaf_rows - leaf.rows());
    while (row < end) {
      const long count = std::min(leaf.room(), end - row);
      for (int c = 0; c <= columns; ++c) {
        for (long r = 0; r < count; ++r) {
          leaf.Next()[c * LeafFactor::kStride + r] = Ay(row + r, c);
        }
      }
      leaf.Commit(count);
      row += count;
    }
    factor.PutLeaf(&leaf);
  }
  EXPECT_EQ(factor.rows(), rows);
  EXPECT_EQ(factor.Triangle(), whole.Triangle());
}

TEST(TriangularFactor, OfAKnownTriangleGoesOn) {
  std::mt19937_64 random(9);
  const MatrixXd Ay = RandomRows(500, 6, &random);
  TriangularFactor first(5);
  AddRows(Ay.topRows(300), &first);
  TriangularFactor factor(first.Triangle(), first.rows());
  EXPECT_EQ(factor.columns(), 5);
  AddRows(Ay.bottomRows(200), &factor);
  ExpectFactorOf(factor, Ay);
}

TEST(TriangularFactor, WeightsColumnsOfRows) {
  std::mt19937_64 random(8);
  const MatrixXd Ay = RandomRows(700, 6, &random);
  const VectorXd weights = UniformVector(&random, 700, 0, 3);
  TriangularFactor factor(5);
  factor.AddRows(Ay.data(), 700, 700, weights.data());
  ExpectFactorOf(factor, weights.asDiagonal() * Ay);
}

// The last column solves the least-squares problem; its corner is the norm of
// what is left. Conditions that normal equations would lose are kept.
TEST(TriangularFactor, SolvesIllConditionedEquations) {
  std::mt19937_64 random(4);
  MatrixXd A = RandomRows(600, 3, &random);
  A.col(2) = A.col(1) + 1e-7 * A.col(2);
  const Eigen::Vector3d x(1, -2, 3);
  TriangularFactor factor(3);
  for (int k = 0; k < A.rows(); ++k) {
    factor.Add(A.row(k), A.row(k).dot(x), 1);
  }
  const MatrixXd R = factor.Triangle();
  const Eigen::Vector3d solution =
      R.topLeftCorner<3, 3>().triangularView<Eigen::Upper>().solve(
          R.topRightCorner<3, 1>());
  EXPECT_LT((solution - x).norm(), 1e-6);
  EXPECT_LT(std::abs(R(3, 3)), 1e-12);
}

}  // namespace armcal::triangular_factor_test
