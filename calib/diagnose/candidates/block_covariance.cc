#include "calib/diagnose/candidates/block_covariance.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <map>
#include <utility>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// M of BlockCovariance; of no rows where there are too few blocks. Blocks in
// which the parameters change nothing, such as those beside a short event, are
// none.
MatrixXd OfBlockScores(const MatrixXd& J, const VectorXd& residual,
                       const std::vector<int>& block_of_row) {
  std::map<int, VectorXd> scores;
  for (size_t i = 0; i < block_of_row.size(); ++i) {
    if (J.row(i).isZero(0)) continue;
    VectorXd& score =
        scores.try_emplace(block_of_row[i], VectorXd::Zero(J.cols()))
            .first->second;
    score += J.row(i).transpose() * residual[i];
  }
  const auto blocks = static_cast<double>(scores.size());
  if (blocks <= J.cols()) return {};
  MatrixXd sum = MatrixXd::Zero(J.cols(), J.cols());
  for (const auto& [block, score] : scores) sum += score * score.transpose();
  return blocks / (blocks - J.cols()) * sum;
}

}  // namespace

std::vector<int> BlocksOfRows(const GapRows& rows) {
  const double duration = GapRows::kPeriodsAtEnds / rows.bandwidth_hz();
  std::map<std::pair<int, int>, int> numbers;  // of a segment's blocks
  std::vector<int> blocks;
  for (int j = 0; j < rows.num_joints(); ++j) {
    for (const GapRows::Place& place : rows.PlacesOfRows(j)) {
      const auto in_segment = static_cast<int>(place.time / duration);
      const auto number = static_cast<int>(numbers.size());
      blocks.push_back(numbers.try_emplace({place.segment, in_segment}, number)
                           .first->second);
    }
  }
  return blocks;
}

// With W W' = H^-1 and the eigenvectors U and eigenvalues l of W' M W, which
// say by how much variances by blocks are those of white noise,
//   C = W U max(1, l) U' W'.
MatrixXd BlockCovariance(const RowMajorMatrix& J, const VectorXd& residual,
                         const std::vector<int>& block_of_row) {
  if (!residual.allFinite() || !J.allFinite()) {
    return MatrixXd::Zero(J.cols(), J.cols());
  }
  const MatrixXd H = J.transpose() * J;
  const MatrixXd inverse = H.completeOrthogonalDecomposition().pseudoInverse();
  const MatrixXd M = OfBlockScores(J, residual, block_of_row);
  if (M.size() == 0) return inverse;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> of_inverse(inverse);
  const MatrixXd W =
      of_inverse.eigenvectors() *
      of_inverse.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> ratios(W.transpose() * M * W);
  const MatrixXd spread = W * ratios.eigenvectors();
  return spread * ratios.eigenvalues().cwiseMax(1).asDiagonal() *
         spread.transpose();
}

}  // namespace armcal
