#pragma once

#include <Eigen/Core>

namespace armcal {

// Puts rows below those of a matrix, which is empty or has as many columns.
inline void AppendRows(const Eigen::MatrixXd& rows, Eigen::MatrixXd* to) {
  const Eigen::Index before = to->rows();
  to->conservativeResize(before + rows.rows(), rows.cols());
  to->bottomRows(rows.rows()) = rows;
}

}  // namespace armcal
