#include "calib/watch/information.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

void RowInformation::Add(const MatrixXd& A, const VectorXd& r,
                         const VectorXd& weight) {
  const MatrixXd root = weight.cwiseSqrt().asDiagonal() * A;
  AtA.selfadjointView<Eigen::Lower>().rankUpdate(root.transpose());
  Atr.noalias() += root.transpose() * weight.cwiseSqrt().cwiseProduct(r);
  rows += A.rows();
}

void RowInformation::Add(const RowInformation& other) {
  if (other.rows == 0) return;
  begin = rows == 0 ? other.begin : std::min(begin, other.begin);
  end = std::max(end, other.end);
  AtA += other.AtA;
  Atr += other.Atr;
  rows += other.rows;
}

MatrixXd CovarianceRoot(const MatrixXd& covariance) {
  // In units of the standard deviations, so that kilograms and N m weigh alike.
  const VectorXd unit = covariance.diagonal().cwiseMax(1e-300).cwiseSqrt();
  const VectorXd inverse = unit.cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(
      inverse.asDiagonal() * covariance * inverse.asDiagonal());
  return unit.asDiagonal() * eigen.eigenvectors() *
         eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

// With the parameters' errors e ~ N(mean, C C') the rows' information on a
// change z is that of its Schur complement. Let L = A'A, b = A'(r - A mean),
// and M = 1 + C'LC = K K'. Then
//   information  B'L B - (K^-1 C'L B)' (K^-1 C'L B)
//   score        B'b   - (K^-1 C'L B)' (K^-1 C'b)
// of theta in z = B theta. half_ = K^-1 C'L, half_r_ = K^-1 C'b.
ChangeTest::ChangeTest(const RowInformation& rows,
                       const ParameterBelief& belief, const MatrixXd& root)
    : AtA_(rows.AtA.selfadjointView<Eigen::Lower>()) {
  const Eigen::Index p = belief.mean.size();
  Atr_ = rows.Atr - AtA_.leftCols(p) * belief.mean;
  const MatrixXd CtL = root.transpose() * AtA_.topRows(p);
  MatrixXd M = CtL.leftCols(p) * root;
  M.diagonal().array() += 1;
  const Eigen::LLT<MatrixXd> factor(M);
  half_ = factor.matrixL().solve(CtL);
  half_r_ = factor.matrixL().solve(root.transpose() * Atr_.head(p));
}

// log Bayes factor of theta ~ N(0, S^2) against theta = 0, of information I and
// score b: b'(I + S^-2)^-1 b / 2 - log det(1 + S I S) / 2. Its second term is
// Occam's: what could have explained anything has explained little.
ChangeEvidence ChangeTest::Of(const WatchHypothesis& change) const {
  const MatrixXd B = change.columns * change.stddev.asDiagonal();
  const MatrixXd shadow = half_ * B;
  MatrixXd M = B.transpose() * (AtA_ * B) - shadow.transpose() * shadow;
  const VectorXd b = B.transpose() * Atr_ - shadow.transpose() * half_r_;
  M.diagonal().array() += 1;
  const Eigen::LLT<MatrixXd> factor(M);
  const MatrixXd K = factor.matrixL();
  ChangeEvidence evidence;
  const VectorXd scaled = factor.solve(b);
  evidence.log_bayes =
      b.dot(scaled) / 2 - K.diagonal().array().max(1e-300).log().sum();
  evidence.log_likelihood =
      b.dot(scaled) - (scaled.dot(M * scaled) - scaled.squaredNorm()) / 2;
  evidence.theta = change.stddev.cwiseProduct(scaled);
  evidence.covariance = change.stddev.asDiagonal() *
                        factor.solve(MatrixXd::Identity(M.rows(), M.cols())) *
                        change.stddev.asDiagonal();
  return evidence;
}

ParameterBelief Updated(const ParameterBelief& belief,
                        const RowInformation& rows) {
  const Eigen::Index p = belief.mean.size();
  const MatrixXd L =
      MatrixXd(rows.AtA.selfadjointView<Eigen::Lower>()).topLeftCorner(p, p);
  const MatrixXd root = CovarianceRoot(belief.covariance);
  MatrixXd M = root.transpose() * L * root;
  M.diagonal().array() += 1;
  const Eigen::LLT<MatrixXd> factor(M);
  const MatrixXd half = factor.matrixL().solve(root.transpose());
  ParameterBelief after;
  after.covariance = half.transpose() * half;
  after.mean =
      belief.mean + after.covariance * (rows.Atr.head(p) - L * belief.mean);
  return after;
}

}  // namespace armcal
