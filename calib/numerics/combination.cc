#include "calib/numerics/combination.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "calib/numerics/readable_sum.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::string Text(const VectorXd& x, const VectorXd& y,
                 const std::vector<std::string>& names) {
  std::string text, only;
  int terms = 0;
  const double largest = y.cwiseAbs().maxCoeff();
  for (int c = 0; c < x.size(); ++c) {
    if (std::abs(y[c]) < 0.05 * largest) continue;
    char factor[32];
    std::snprintf(factor, sizeof(factor), "%.2f ", std::abs(x[c]));
    if (text.empty()) {
      text = x[c] < 0 ? "-" : "";
    } else {
      text += x[c] < 0 ? " - " : " + ";
    }
    only = names[c];
    text += factor + InBrackets(only);
    ++terms;
  }
  return terms == 1 ? only : text;
}

MatrixXd EchelonBasis(const MatrixXd& N) {
  MatrixXd rows = N.transpose();
  std::vector<std::pair<Eigen::Index, Eigen::Index>> pivots;  // column, row
  for (Eigen::Index k = 0; k < rows.rows(); ++k) {
    Eigen::Index r, c;
    rows.bottomRows(rows.rows() - k).cwiseAbs().maxCoeff(&r, &c);
    rows.row(k).swap(rows.row(k + r));
    rows.row(k) /= rows(k, c);
    for (Eigen::Index other = 0; other < rows.rows(); ++other) {
      if (other == k) continue;
      const double factor = rows(other, c);
      rows.row(other) -= factor * rows.row(k);
    }
    pivots.emplace_back(c, k);
  }
  std::sort(pivots.begin(), pivots.end());
  MatrixXd basis(N.rows(), N.cols());
  for (size_t k = 0; k < pivots.size(); ++k) {
    basis.col(k) = rows.row(pivots[k].second).transpose();
  }
  return basis;
}

}  // namespace

std::vector<Combination> NameCombinations(
    const MatrixXd& N, const VectorXd& scale,
    const std::vector<std::string>& names) {
  const MatrixXd basis = EchelonBasis(N);
  std::vector<Combination> combinations;
  for (Eigen::Index k = 0; k < basis.cols(); ++k) {
    Combination c;
    c.x = basis.col(k).cwiseQuotient(scale);
    // Normalised and signed by the entry that matters most.
    Eigen::Index lead;
    c.x.cwiseAbs().maxCoeff(&lead);
    c.x /= c.x[lead];
    c.text = Text(c.x, basis.col(k), names);
    combinations.push_back(c);
  }
  return combinations;
}

}  // namespace armcal
