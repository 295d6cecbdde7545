#include "problems/excitation_criterion.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNorm = 12;  // of standard deviations, for the worst

// The covariance S = M^-1 of the information M, with every quantity in a unit
// in which it alone, the others being known, has information 1. This makes the
// diagonal of M one, which among all scalings brings its condition number
// within a factor of its size of the least possible (van der Sluis 1969; Higham
// 2002, 7.3). Without it the units of masses and lengths would decide what
// counts as singular.
struct ScaledCovariance {
  VectorXd unit;  // of theta
  MatrixXd value;
};

// Inverts the information by Cholesky, M = L L'. In these units L_kk^2 is the
// share of a quantity's information that the quantities before it leave, so
// that one threshold on pivots tells open quantities in any unit.
std::optional<ScaledCovariance> Invert(const MatrixXd& information) {
  ScaledCovariance covariance;
  covariance.unit = information.diagonal().cwiseSqrt().cwiseInverse();
  if (!covariance.unit.allFinite()) return {};
  const MatrixXd scaled =
      covariance.unit.asDiagonal() * information * covariance.unit.asDiagonal();
  const Eigen::LLT<MatrixXd> factor(scaled);
  constexpr double kLeastPivot = 1e-7;  // its square is what rounding leaves
  if (factor.info() != Eigen::Success ||
      !(factor.matrixLLT().diagonal().minCoeff() > kLeastPivot)) {
    return {};
  }
  covariance.value =
      factor.solve(MatrixXd::Identity(scaled.rows(), scaled.cols()));
  return covariance;
}

// The logarithm f of the criterion of the wanted's scaled covariance C (k x k)
// and its gradient, df = tr(of_C' dC). The criteria are the classical ones of
// optimal design (Pukelsheim 1993, Optimal Design of Experiments, ch. 6), as
// standard deviations and as logarithms, so that a cost of 0.1 is 10 % of a
// deviation whichever is chosen:
//   D      log det C / (2 k),          of_C = C^-1 / (2 k)
//   A      log(tr C / k) / 2,          of_C = 1 / (2 tr C)
//   worst  log(sum_i C_ii^6) / 12,     of_C_ii = C_ii^5 / (2 sum_i C_ii^6)
// The last one is the 12-norm of the deviations: at most k^(1/12) above the
// largest of them, and smooth where the largest changes hands, which a
// quasi-Newton method needs. It is divided by the largest to keep C_ii^6
// finite.
double OfCovariance(ExcitationCriterion criterion, const MatrixXd& C,
                    MatrixXd* of_C) {
  const auto size = static_cast<double>(C.rows());
  const VectorXd variance = C.diagonal();
  switch (criterion) {
    case ExcitationCriterion::kD: {
      const Eigen::LLT<MatrixXd> factor(C);
      *of_C = factor.solve(MatrixXd::Identity(C.rows(), C.cols())) / (2 * size);
      return factor.matrixLLT().diagonal().array().log().sum() / size;
    }
    case ExcitationCriterion::kA: {
      const double trace = variance.sum();
      *of_C = MatrixXd::Identity(C.rows(), C.cols()) / (2 * trace);
      return .5 * std::log(trace / size);
    }
    case ExcitationCriterion::kWorst: {
      const double largest = variance.maxCoeff();
      const VectorXd share =
          (variance / largest).array().pow(kNorm / 2).matrix();
      *of_C = (share.array() / variance.array() / (2 * share.sum()))
                  .matrix()
                  .asDiagonal();
      return .5 * std::log(largest) + std::log(share.sum()) / kNorm;
    }
  }
  return 0;
}

}  // namespace

// Follows the criterion from the information A of a motion to the wanted
// quantities. The model parameters X(theta) carry it to theta, M = J' A J +
// known, whose inverse S bounds the covariance of theta (Cramer-Rao). With E,
// which selects and scales the wanted, C = E' S E. As d(M^-1) = -M^-1 dM M^-1,
// the gradient is
//   of_A = -(J S E) of_C (J S E)',
// so that S E, once found, serves both the value and the gradient.
std::optional<double> EvaluateCriterion(ExcitationCriterion criterion,
                                        const DesignQuantities& quantities,
                                        const MatrixXd& A, MatrixXd* of_A) {
  const MatrixXd& J = quantities.J;
  const std::optional<ScaledCovariance> covariance =
      Invert(J.transpose() * A * J + quantities.known);
  if (!covariance) return {};
  // S: covariance times what selects and scales the wanted, C = E' S E.
  const auto count = static_cast<Eigen::Index>(quantities.wanted.size());
  MatrixXd columns(J.cols(), count), C(count, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const int w = quantities.wanted[k];
    columns.col(k) = covariance->unit.asDiagonal() * covariance->value.col(w) *
                     (covariance->unit[w] / quantities.scale[k]);
  }
  for (Eigen::Index k = 0; k < count; ++k) {
    C.row(k) = columns.row(quantities.wanted[k]) / quantities.scale[k];
  }
  MatrixXd of_C;
  const double value = OfCovariance(criterion, C, &of_C);
  // dS = -S dM S.
  const MatrixXd J_columns = J * columns;
  *of_A = -J_columns * of_C * J_columns.transpose();
  return value;
}

VectorXd PredictedStddev(const DesignQuantities& quantities,
                         const MatrixXd& A) {
  const MatrixXd& J = quantities.J;
  const std::optional<ScaledCovariance> covariance =
      Invert(J.transpose() * A * J + quantities.known);
  if (!covariance) {
    return VectorXd::Constant(J.cols(),
                              std::numeric_limits<double>::infinity());
  }
  return covariance->unit.cwiseProduct(
      covariance->value.diagonal().cwiseSqrt());
}

}  // namespace armcal
