#include "calib/linear/overlap_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "model/text/uniform_draw.h"
#include "tests/fixtures/sample_motion.h"

namespace armcal::overlap_covariance_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kLags = 4;

// Moving averages of white noise with this kernel follow each other at lags
// below kLags only.
const double kKernel[kLags] = {.3, 1, 1, .3};

// Errors of `rows` rows, joint after joint, and their covariance.
MatrixXd MovingAverage(std::mt19937_64* random, int rows, int joints) {
  MatrixXd e = MatrixXd::Zero(rows, joints);
  for (int j = 0; j < joints; ++j) {
    VectorXd white(rows + kLags);
    for (double& x : white) x = (j + 1) * Normal(random);
    for (int k = 0; k < rows; ++k) {
      for (int l = 0; l < kLags; ++l) e(k, j) += kKernel[l] * white[k + l];
    }
  }
  return e;
}

MatrixXd CovarianceOf(int rows, int joint) {
  MatrixXd C = MatrixXd::Zero(rows, rows);
  for (int a = 0; a < rows; ++a) {
    for (int b = 0; b < rows; ++b) {
      for (int l = 0; l < kLags; ++l) {
        const int m = l + a - b;
        if (m < 0 || m >= kLags) continue;
        C(a, b) += (joint + 1) * (joint + 1) * kKernel[l] * kKernel[m];
      }
    }
  }
  return C;
}

constexpr int kRows = 120, kJoints = 2, kSize = 5;

// Equations of two joints and how the loss passes on changes of each residual.
struct Equations {
  Equations() : U(kJoints, MatrixXd(kRows, kSize)) {
    for (int j = 0; j < kJoints; ++j) {
      for (int c = 0; c < kSize; ++c) {  // slow and fast columns
        for (int k = 0; k < kRows; ++k) {
          U[j](k, c) = std::sin(.02 * (1 + c * c) * k + c + j);
        }
      }
    }
    slope = MatrixXd::Ones(kRows, kJoints);
  }
  MatrixXd Gain() const {
    MatrixXd H = MatrixXd::Zero(kSize, kSize);
    for (int j = 0; j < kJoints; ++j) {
      H += U[j].transpose() * slope.col(j).asDiagonal() * U[j];
    }
    return H.inverse();
  }
  // The mean of Value() is the covariance of the estimate x = gain U'e, which
  // linear algebra gives exactly.
  void ExpectTheEstimates(double tolerance) const {
    const MatrixXd gain = Gain();
    MatrixXd exact = MatrixXd::Zero(kSize, kSize), mean = exact;
    for (int j = 0; j < kJoints; ++j) {
      exact += gain * U[j].transpose() * CovarianceOf(kRows, j) * U[j] * gain;
    }
    std::mt19937_64 random(5);
    constexpr int kRuns = 400;
    for (int run = 0; run < kRuns; ++run) {
      const MatrixXd e = MovingAverage(&random, kRows, kJoints);
      VectorXd x = VectorXd::Zero(kSize);
      for (int j = 0; j < kJoints; ++j) {
        x += gain * U[j].transpose() * e.col(j);
      }
      OverlapCovariance overlap(kJoints, kSize, kLags);
      for (int k = 0; k < kRows; ++k) overlap.Add(RowOf(e, x, k));
      mean += overlap.Value(gain, VectorXd::Ones(kJoints)) / kRuns;
    }
    for (int k = 0; k < kSize; ++k) {
      EXPECT_NEAR(mean(k, k) / exact(k, k), 1, tolerance) << k;
    }
  }
  FittedRow RowOf(const MatrixXd& e, const VectorXd& x, int k) const {
    FittedRow row{MatrixXd(kJoints, kSize),
                  VectorXd(kJoints),
                  {true, true},
                  slope.row(k)};
    for (int j = 0; j < kJoints; ++j) {
      row.U.row(j) = U[j].row(k);
      row.r[j] = e(k, j) - slope(k, j) * U[j].row(k) * x;
    }
    return row;
  }

  std::vector<MatrixXd> U;
  MatrixXd slope;  // kRows x kJoints
};

// Least squares with known weights.
TEST(OverlapCovariance, IsThatOfTheEstimate) {
  Equations().ExpectTheEstimates(.06);
}

// A loss that bends where rows are large: they tell little, and the fit has
// taken as little of their residuals.
TEST(OverlapCovariance, OfALossThatGivesUpWhatTellsMost) {
  Equations equations;
  for (MatrixXd& U : equations.U) U.middleRows(50, 15) *= 5;
  for (int k = 50; k < 65; ++k) equations.slope.row(k).setConstant(.1);
  equations.ExpectTheEstimates(.06);
}

// Pairs of rows are the same pairs backwards, wherever sums were added up
// between.
TEST(OverlapCovariance, IsTheSameBackwards) {
  Equations equations;
  std::mt19937_64 random(6);
  for (double& s : equations.slope.reshaped())
    s = .5 + .5 * UniformDraw(&random);
  const MatrixXd e = MovingAverage(&random, kRows, kJoints);
  const VectorXd x = VectorXd::Zero(kSize);
  OverlapCovariance forwards(kJoints, kSize, kLags);
  OverlapCovariance backwards = forwards;
  for (int k = 0; k < kRows; ++k) {
    if (k == 40 || k == 43) forwards.Break();
    forwards.Add(equations.RowOf(e, x, k));
    const int last = kRows - 1 - k;
    if (last == 39 || last == 42) backwards.Break();
    backwards.Add(equations.RowOf(e, x, last));
  }
  const MatrixXd gain = equations.Gain();
  const VectorXd scale = VectorXd::Ones(kJoints);
  const MatrixXd expected = forwards.Value(gain, scale);
  EXPECT_LT((backwards.Value(gain, scale) - expected).norm(),
            1e-10 * expected.norm());
}

TEST(RaiseTo, ScalesRowsAndColumnsAndNeverDown) {
  const MatrixXd C = (MatrixXd(2, 2) << 4, 1, 1, 9).finished();
  const MatrixXd raised = RaiseTo(VectorXd(Eigen::Vector2d(16, 1)), C);
  EXPECT_EQ(raised, (MatrixXd(2, 2) << 16, 2, 2, 9).finished());
}

}  // namespace armcal::overlap_covariance_test
