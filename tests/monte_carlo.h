#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "calib/linear_calibration.h"

namespace armcal {

inline double Median(Eigen::VectorXd x) {
  std::nth_element(x.begin(), x.begin() + x.size() / 2, x.end());
  return x[x.size() / 2];
}

// Errors over many runs of a calibration whose truth X is known.
struct MonteCarlo {
  using VectorXd = Eigen::VectorXd;

  explicit MonteCarlo(const VectorXd& X_in)
      : X(X_in),
        sum(VectorXd::Zero(X.size())),
        squares(sum),
        claimed(sum),
        covered(sum) {}
  void Add(const VectorXd& x, const VectorXd& stddev) {
    const VectorXd error = x - X;
    sum += error;
    squares += error.cwiseAbs2();
    claimed += stddev;
    for (int k = 0; k < X.size(); ++k) {
      covered[k] += std::abs(error[k]) < 1.96 * stddev[k];
    }
    ++runs;
  }
  void Add(const LinearCalibration& result) {
    ASSERT_TRUE(result.solved) << result.reason;
    Add(result.x, result.stddev);
  }
  VectorXd bias() const { return sum / runs; }
  VectorXd stddev() const {
    return ((squares / runs - bias().cwiseAbs2()) * runs / (runs - 1))
        .cwiseSqrt();
  }
  VectorXd rmse() const { return (squares / runs).cwiseSqrt(); }
  // Mean claimed standard deviation over the true one.
  VectorXd honesty() const { return (claimed / runs).cwiseQuotient(stddev()); }
  VectorXd bias_percent() const {
    return 100 * bias().cwiseQuotient(X.cwiseAbs());
  }
  VectorXd stddev_percent() const {
    return 100 * stddev().cwiseQuotient(X.cwiseAbs());
  }
  // How often 95 % intervals hold the truth, %: mean and worst parameter.
  double coverage() const { return 100 * covered.mean() / runs; }
  double least_coverage() const { return 100 * covered.minCoeff() / runs; }
  void Print(const char* what) const {
    std::printf("%s\n", what);
    const auto line = [&](const char* name, const VectorXd& x) {
      std::printf("  %-24s", name);
      for (const double v : x) std::printf(" %9.4f", v);
      std::printf("\n");
    };
    if (X.cwiseAbs().minCoeff() > 0) {
      line("bias %", bias_percent());
      line("stddev %", stddev_percent());
    }
    line("claimed / true stddev", honesty());
    line("coverage %", 100 * covered / runs);
  }

  VectorXd X, sum, squares, claimed, covered;
  double runs = 0;
};

}  // namespace armcal
