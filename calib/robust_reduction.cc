#include "calib/robust_reduction.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

RobustReduction::RobustReduction(const Point& at,
                                 const MotionFunctions& functions,
                                 long leaf_rows)
    : at_(at),
      columns_(functions.row_columns()),
      reduction_(RowSizes(functions, 0)),
      residuals_(reduction_.num_slots()),
      statistics_(columns_.size()) {
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
          for (const double r : residuals_[slot][i]) statistics_[i].Add(r);
          residuals_[slot][i].clear();
        }
      });
}

void RobustReduction::WeighJoint(const ReducedRows& rows, int joint,
                                 bool used) {
  using Columns = Eigen::Map<MatrixXd, 0, Eigen::OuterStride<>>;
  const std::vector<int>& columns = columns_[joint];
  const auto size = static_cast<Eigen::Index>(columns.size());
  Columns A(rows.columns[joint], rows.count, size + 1,
            Eigen::OuterStride<>(rows.stride));
  if (!used) {
    A.setZero();
    return;
  }
  auto y = A.col(size);
  const VectorXd x = at_.x(columns);
  y.noalias() +=
      A.middleCols(size - at_.nonlinear, at_.nonlinear) * x.tail(at_.nonlinear);
  std::vector<double>& residuals = residuals_[rows.slot][joint];
  const VectorXd r = (y - A.leftCols(size) * x) / at_.noise[joint];
  residuals.insert(residuals.end(), r.data(), r.data() + r.size());
  if (at_.loss == RobustLoss::kSquared) return;
  VectorXd root(rows.count);
  for (Eigen::Index s = 0; s < rows.count; ++s) {
    root[s] = std::sqrt(EvaluateLoss(at_.loss, r[s]).weight);
  }
  if ((root.array() == 1).all()) return;
  for (auto column : A.colwise()) column.array() *= root.array();
}

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
