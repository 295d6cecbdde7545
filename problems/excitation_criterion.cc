#include "problems/excitation_criterion.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNorm = 12;  // of standard deviations, for the worst

// The covariance of all quantities in units in which each alone has
// information 1; nothing where there is none.
struct ScaledCovariance {
  VectorXd unit;  // of theta
  MatrixXd value;
};

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

// log of the criterion of the wanted's scaled covariance C, and d/dC.
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
