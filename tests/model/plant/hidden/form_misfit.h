#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace armcal {

// Share of y that no combination of the columns explains, for the best of the
// nonlinear parameters.
inline double Misfit(const Eigen::VectorXd& y,
                     const std::vector<double>& nonlinear,
                     const std::function<Eigen::MatrixXd(double)>& columns) {
  double best = 1;
  for (const double w : nonlinear) {
    const Eigen::MatrixXd A = columns(w);
    const Eigen::VectorXd x = A.colPivHouseholderQr().solve(y);
    best = std::min(best, (y - A * x).norm() / y.norm());
  }
  return best;
}

inline std::vector<double> Grid(double low, double high) {
  std::vector<double> grid;
  for (int k = 0; k <= 200; ++k) {
    grid.push_back(low * std::pow(high / low, k / 200.));
  }
  return grid;
}

inline Eigen::MatrixXd Columns(const std::vector<Eigen::VectorXd>& columns) {
  Eigen::MatrixXd A(columns[0].size(), columns.size());
  for (size_t k = 0; k < columns.size(); ++k) A.col(k) = columns[k];
  return A;
}

// Another law than the form, of the same thing.
inline void ExpectAnotherForm(double misfit, double least, double most,
                              const char* name) {
  EXPECT_GT(misfit, least) << name;
  EXPECT_LT(misfit, most) << name;
}

inline Eigen::VectorXd Along(const Eigen::VectorXd& x,
                             const std::function<double(double)>& f) {
  return x.unaryExpr(f);
}

}  // namespace armcal
