#include "model/signals/column_basis.h"

#include <Eigen/QR>

namespace armcal {

bool ColumnBasis::Add(const Eigen::VectorXd& column, double scale,
                      double tolerance) {
  Eigen::VectorXd v = column;
  for (int pass = 0; pass < 2; ++pass) v -= Q_ * (Q_.transpose() * v).eval();
  const double norm = v.norm();
  if (norm <= tolerance * scale) return false;
  Q_.conservativeResize(Eigen::NoChange, Q_.cols() + 1);
  Q_.rightCols(1) = v / norm;
  return true;
}

Eigen::VectorXd ExpressInColumns(const Eigen::MatrixXd& A, int j,
                                 const std::vector<int>& kept) {
  if (kept.empty()) return {};  // Eigen's QR takes no matrix without columns
  Eigen::MatrixXd B(A.rows(), kept.size());
  for (size_t k = 0; k < kept.size(); ++k) B.col(k) = A.col(kept[k]);
  Eigen::VectorXd c = B.colPivHouseholderQr().solve(A.col(j));
  return (c.array().abs() < 1e-10).select(0, c);
}

}  // namespace armcal
