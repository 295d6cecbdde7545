#include "calib/overlap_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "tests/sample_motion.h"

namespace armcal {
namespace {

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

// Least squares with known weights: the mean of Value() is the covariance of
// the estimate, which linear algebra gives exactly.
TEST(OverlapCovariance, IsThatOfTheEstimate) {
  constexpr int kRows = 120, kJoints = 2, kSize = 5, kRuns = 400;
  std::mt19937_64 random(5);
  std::vector<MatrixXd> U(kJoints, MatrixXd(kRows, kSize));
  MatrixXd H = MatrixXd::Zero(kSize, kSize), exact = H;
  for (int j = 0; j < kJoints; ++j) {
    for (int c = 0; c < kSize; ++c) {  // slow and fast columns
      for (int k = 0; k < kRows; ++k) {
        U[j](k, c) = std::sin(.02 * (1 + c * c) * k + c + j);
      }
    }
    H += U[j].transpose() * U[j];
  }
  const MatrixXd gain = H.inverse();
  for (int j = 0; j < kJoints; ++j) {
    exact += gain * U[j].transpose() * CovarianceOf(kRows, j) * U[j] * gain;
  }
  MatrixXd mean = MatrixXd::Zero(kSize, kSize);
  for (int run = 0; run < kRuns; ++run) {
    const MatrixXd e = MovingAverage(&random, kRows, kJoints);
    VectorXd x = VectorXd::Zero(kSize);
    for (int j = 0; j < kJoints; ++j) {
      x += gain * U[j].transpose() * e.col(j);
    }
    OverlapCovariance overlap(kJoints, kSize, kLags);
    for (int k = 0; k < kRows; ++k) {
      FittedRow row{MatrixXd(kJoints, kSize),
                    VectorXd(kJoints),
                    {true, true},
                    {true, true}};
      for (int j = 0; j < kJoints; ++j) {
        row.U.row(j) = U[j].row(k);
        row.r[j] = e(k, j) - U[j].row(k) * x;
      }
      overlap.Add(row);
    }
    mean += overlap.Value(gain, VectorXd::Ones(kJoints)) / kRuns;
  }
  for (int k = 0; k < kSize; ++k) {
    EXPECT_NEAR(mean(k, k) / exact(k, k), 1, .06) << k;
  }
}

TEST(RaiseTo, ScalesRowsAndColumnsAndNeverDown) {
  const MatrixXd C = (MatrixXd(2, 2) << 4, 1, 1, 9).finished();
  const MatrixXd raised = RaiseTo(VectorXd(Eigen::Vector2d(16, 1)), C);
  EXPECT_EQ(raised, (MatrixXd(2, 2) << 16, 2, 2, 9).finished());
}

}  // namespace
}  // namespace armcal
