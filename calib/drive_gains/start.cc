#include "calib/drive_gains/start.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "model/signals/dense_solvers.h"

namespace armcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDependent = 1e-9;  // beside the largest

// The equations at gains g are linear in [x; p]: columns and left side.
struct LinearSystem {
  MatrixXd A;  // rows x (m + 10)
  MatrixXd Z;  // rows x n, the current of each joint in its own column
};

LinearSystem Stack(const std::vector<CurrentEquations>& equations,
                   const MatrixXd& B, const VectorXd& g) {
  const Index m = B.rows();
  Index rows = 0;
  for (const CurrentEquations& e : equations) rows += e.A.rows();
  LinearSystem system{MatrixXd::Zero(rows, m + 10),
                      MatrixXd::Zero(rows, g.size())};
  Index at = 0;
  for (const CurrentEquations& e : equations) {
    const Index k = e.A.rows();
    system.A.block(at, 0, k, m) = g[e.joint] * e.A;
    if (e.loaded) system.A.block(at, m, k, 10) = g[e.joint] * e.A * B;
    system.Z.col(e.joint).segment(at, k) = e.z;
    at += k;
  }
  return system;
}

// Columns of unit length, so that units do not decide what is dependent.
VectorXd InverseNorms(const MatrixXd& A) {
  VectorXd inverse = A.colwise().norm();
  for (double& x : inverse) x = x > 0 ? 1 / x : 1;
  return inverse;
}

// Relative corrections of the gains' inverses, K_j = correction_j / g_j.
VectorXd Corrections(const LinearSystem& system, const VectorXd& rows) {
  const Index n = rows.size();
  Eigen::ColPivHouseholderQR<MatrixXd> qr;
  qr.setThreshold(kDependent);
  qr.compute(system.A * InverseNorms(system.A).asDiagonal());
  const MatrixXd left = (qr.householderQ().transpose() * system.Z)
                            .bottomRows(system.A.rows() - qr.rank());
  // Errors of a current of unit noise have length sqrt(rows).
  VectorXd unit = rows.cwiseMax(1).cwiseSqrt();
  const Eigen::JacobiSVD<MatrixXd> svd(left * unit.cwiseInverse().asDiagonal(),
                                       Eigen::ComputeFullV);
  VectorXd s = VectorXd::Zero(n);
  s.head(svd.singularValues().size()) = svd.singularValues();
  const double least = std::max(1.0, s.minCoeff());
  VectorXd corrections = VectorXd::Zero(n);
  for (Index k = 0; k < n; ++k) {
    if (s[k] > 3 * least) continue;
    const VectorXd v = svd.matrixV().col(k);
    corrections += v.dot(unit) * v;
  }
  corrections = corrections.cwiseQuotient(unit);
  const double floor = 1e-3 * corrections.cwiseAbs().maxCoeff();
  for (double& c : corrections) {
    if (std::abs(c) <= floor) c = floor > 0 ? floor : 1;
  }
  return corrections;
}

}  // namespace

GainEstimate StartGains(const std::vector<CurrentEquations>& equations,
                        const MatrixXd& B, const VectorXd& rows,
                        const VectorXd& guess, int reference) {
  constexpr int kRounds = 6;  // the weights follow the gains
  GainEstimate start;
  start.g = guess;
  for (int round = 0; round < kRounds; ++round) {
    const VectorXd corrections =
        Corrections(Stack(equations, B, start.g), rows);
    for (Index j = 0; j < rows.size(); ++j) {
      start.g[j] = rows[j] > 0 ? start.g[j] / corrections[j] : start.g[j];
    }
    start.g /= start.g[reference];
  }
  for (Index j = 0; j < rows.size(); ++j) {
    if (rows[j] == 0) start.g[j] = 1;
  }
  const LinearSystem system = Stack(equations, B, start.g);
  const VectorXd scale = InverseNorms(system.A);
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver;
  solver.setThreshold(kDependent);
  solver.compute(system.A * scale.asDiagonal());
  const VectorXd solution =
      scale.cwiseProduct(solver.solve(VectorXd(system.Z.rowwise().sum())));
  start.x = solution.head(B.rows());
  start.p = solution.tail(10);
  return start;
}

}  // namespace armcal
