#include "calib/linear/robust_reduction.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;

// Adds factor * from to `to`, sample by sample, which gives the same bits for a
// sample whichever others are there.
void AddTimes(double factor, const double* from, long count, double* to) {
  for (long s = 0; s < count; ++s) to[s] += factor * from[s];
}

}  // namespace

RobustReduction::RobustReduction(const Point& at,
                                 const MotionFunctions& functions,
                                 long leaf_rows)
    : at_(at),
      columns_(functions.row_columns()),
      reduction_(RowSizes(functions, 0)),
      residuals_(reduction_.num_slots()),
      spreads_(columns_.size()) {
  for (const std::vector<int>& columns : columns_) {
    factors_.emplace_back(static_cast<int>(columns.size()), leaf_rows);
  }
  for (auto& of_slot : residuals_) of_slot.resize(columns_.size());
}

void RobustReduction::Add(const IdentificationRows& rows,
                          const std::vector<bool>& used) {
  reduction_.Add(
      rows, &factors_,
      [&](const ReducedRows& stretch) {
        for (size_t i = 0; i < columns_.size(); ++i) {
          WeighJoint(stretch, static_cast<int>(i), used[i]);
        }
      },
      [&](int slot) {
        for (size_t i = 0; i < columns_.size(); ++i) {
          for (const double r : residuals_[slot][i]) spreads_[i].Add(r);
          residuals_[slot][i].clear();
        }
      });
}

// One step of iteratively reweighted least squares on rows while they are in
// the cache: with r = (y - u x) / noise, rows and right side are multiplied by
// sqrt(psi(r) / r), so that least squares of them has the score of the loss
// (Holland & Welsch 1977, Comm. Statist. A6). Nonlinear columns J are
// derivatives, y - f(x) = J dx; adding J x to y makes x itself the unknown
// instead of dx.
void RobustReduction::WeighJoint(const ReducedRows& rows, int joint,
                                 bool used) {
  const std::vector<int>& columns = columns_[joint];
  const auto size = static_cast<long>(columns.size());
  double* const first = rows.columns[joint];
  double* const y = first + size * rows.stride;
  if (!used) {
    for (long c = 0; c <= size; ++c) {
      std::fill_n(first + c * rows.stride, rows.count, 0.0);
    }
    return;
  }
  for (long c = size - at_.nonlinear; c < size; ++c) {
    AddTimes(at_.x[columns[c]], first + c * rows.stride, rows.count, y);
  }
  if (at_.loss == RobustLoss::kSquared && !at_.with_spread) return;
  std::vector<double> r(y, y + rows.count);
  for (long c = 0; c < size; ++c) {
    AddTimes(-at_.x[columns[c]], first + c * rows.stride, rows.count, r.data());
  }
  std::vector<double>& residuals = residuals_[rows.slot][joint];
  for (double& x : r) x /= at_.noise[joint];
  if (at_.with_spread) residuals.insert(residuals.end(), r.begin(), r.end());
  if (at_.loss == RobustLoss::kSquared) return;
  for (long s = 0; s < rows.count; ++s) {
    const double root = std::sqrt(EvaluateLoss(at_.loss, r[s]).weight);
    if (root == 1) continue;
    for (long c = 0; c <= size; ++c) first[c * rows.stride + s] *= root;
  }
}

// Puts the joints' triangles into all parameters' columns, divides them by the
// noise and triangularises them together.
MatrixXd RobustReduction::Triangle() const {
  const auto size = static_cast<int>(at_.x.size());
  TriangularFactor all(size);
  for (size_t i = 0; i < factors_.size(); ++i) {
    const MatrixXd& R = factors_[i].Triangle();
    const Eigen::Index rows = R.rows();
    std::vector<int> columns = columns_[i];
    columns.push_back(size);
    MatrixXd spread = MatrixXd::Zero(rows, size + 1);
    spread(Eigen::all, columns) = R / at_.noise[static_cast<int>(i)];
    all.AddRows(spread.data(), rows, rows);
  }
  return all.Triangle();
}

}  // namespace armcal
