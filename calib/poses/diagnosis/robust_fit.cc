#include "calib/poses/diagnosis/robust_fit.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kMostRobustSteps = 40;
// Of -2 log p: models are compared to the tenth.
constexpr double kCostAtRest = 1e-3;

// 1 / variance of what else has told each term's amount; 0: nothing has.
VectorXd ToldPrecision(const std::vector<PoseTerm>& terms) {
  VectorXd precision(terms.size());
  for (size_t k = 0; k < terms.size(); ++k) {
    const double stddev = terms[k].told.stddev;
    precision[static_cast<Eigen::Index>(k)] =
        stddev > 0 ? 1 / (stddev * stddev) : 0;
  }
  return precision;
}

VectorXd FromTold(const std::vector<PoseTerm>& terms, const PoseState& at) {
  VectorXd away = at.amounts;
  for (size_t k = 0; k < terms.size(); ++k) {
    away[static_cast<Eigen::Index>(k)] -= terms[k].told.value;
  }
  return away;
}

double PriorCost(const PoseEquations& equations,
                 const std::vector<PoseTerm>& terms, const PoseState& state) {
  return equations.FromFile(state).cwiseAbs2().dot(equations.Precision()) +
         FromTold(terms, state).cwiseAbs2().dot(ToldPrecision(terms));
}

// The step of A step = b that leaves no amount below its least: what would go
// there stops at it, and the others are solved for anew.
VectorXd BoundedStep(const MatrixXd& A, const VectorXd& b,
                     const std::vector<PoseTerm>& terms,
                     const VectorXd& amounts) {
  const Eigen::Index first = b.size() - amounts.size();
  std::vector<bool> stopped(amounts.size(), false);
  for (;;) {
    std::vector<Eigen::Index> moving;
    VectorXd step = VectorXd::Zero(b.size());
    for (Eigen::Index k = 0; k < b.size(); ++k) {
      if (k < first || !stopped[k - first]) {
        moving.push_back(k);
      } else {
        step[k] = terms[k - first].least - amounts[k - first];
      }
    }
    const VectorXd pull = b - A * step;
    step(moving) = A(moving, moving).ldlt().solve(pull(moving)).eval();
    bool again = false;
    for (Eigen::Index k = 0; k < amounts.size(); ++k) {
      if (stopped[k] || !(amounts[k] + step[first + k] < terms[k].least)) {
        continue;
      }
      stopped[k] = again = true;
    }
    if (!again) return step;
  }
}

// One step: moves to a state of lower -2 log p and says by how much. Damping
// grows tenfold until there is one.
double Improve(const PoseEquations& equations,
               const std::vector<PoseTerm>& terms, double* damping,
               PoseEstimate* at) {
  const MatrixXd columns = equations.Columns(at->linear, terms);
  MatrixXd J(columns.rows(), at->linear.geometry.cols() + columns.cols());
  J << at->linear.geometry, columns;
  const MatrixXd A = PoseInformation(equations, *at, columns);
  VectorXd b =
      -WeightedRows(*at, J).transpose() * WeightedRows(*at, at->linear.r);
  b -= PriorPull(equations, terms, at->state);
  for (; *damping < 1e7; *damping *= 10) {
    MatrixXd damped = A;
    damped.diagonal() *= 1 + *damping;
    damped.diagonal().array() += 1e-12;
    const PoseState moved = equations.Moved(
        at->state, BoundedStep(damped, b, terms, at->state.amounts));
    const StudentFit errors = FitStudent(equations.Residuals(terms, moved),
                                         equations.width(), at->nu);
    const double prior = PriorCost(equations, terms, moved);
    const double lower = at->Cost() - errors.deviance - prior;
    if (!(lower >= 0)) continue;
    at->state = moved;
    at->errors = errors;
    at->prior = prior;
    *damping = std::max(1e-9, *damping / 100);
    return lower;
  }
  return 0;
}

}  // namespace

VectorXd PriorPull(const PoseEquations& equations,
                   const std::vector<PoseTerm>& terms, const PoseState& at) {
  VectorXd pull(equations.num_free() + at.amounts.size());
  pull << equations.Precision().cwiseProduct(equations.FromFile(at)),
      ToldPrecision(terms).cwiseProduct(FromTold(terms, at));
  return pull;
}

MatrixXd WeightedRows(const PoseEstimate& at, const MatrixXd& rows) {
  const VectorXd& w = at.errors.weights;
  const Eigen::Index width = rows.rows() / w.size();
  MatrixXd weighted(rows.rows(), rows.cols());
  for (Eigen::Index k = 0; k < w.size(); ++k) {
    weighted.middleRows(k * width, width) =
        rows.middleRows(k * width, width) * (std::sqrt(w[k]) / at.errors.scale);
  }
  return weighted;
}

MatrixXd PoseInformation(const PoseEquations& equations, const PoseEstimate& at,
                         const MatrixXd& columns) {
  MatrixXd J(at.linear.geometry.rows(),
             at.linear.geometry.cols() + columns.cols());
  J << at.linear.geometry, columns;
  const MatrixXd weighted = WeightedRows(at, J);
  MatrixXd A = weighted.transpose() * weighted;
  A.diagonal().head(equations.num_free()) += equations.Precision();
  if (columns.cols() > 0) A.diagonal().tail(columns.cols()) += at.told;
  return A;
}

// Levenberg and Marquardt on -2 log p, errors' scale and weights found anew at
// each state. The effective number of parameters is trace (J'WJ) A^-1 = size -
// trace P A^-1, P being the prior's information: one that only its prior tells
// counts nothing.
PoseEstimate EstimatePoses(const PoseEquations& equations,
                           const std::vector<PoseTerm>& terms, double nu,
                           const PoseState& start) {
  PoseEstimate at;
  at.nu = nu;
  at.state = start;
  at.told = ToldPrecision(terms);
  at.linear = equations.Linearise(terms, start, false);
  at.errors = FitStudent(at.linear.r, equations.width(), nu);
  at.prior = PriorCost(equations, terms, start);
  double damping = 1e-9;
  for (int step = 0; step < kMostRobustSteps; ++step) {
    const double lower = Improve(equations, terms, &damping, &at);
    at.linear = equations.Linearise(terms, at.state, false);
    if (lower < kCostAtRest) break;
  }
  const MatrixXd A =
      PoseInformation(equations, at, MatrixXd(at.linear.r.size(), 0));
  const VectorXd precision = equations.Precision();
  const MatrixXd inverse =
      A.ldlt().solve(MatrixXd::Identity(A.rows(), A.cols()));
  at.parameters =
      static_cast<double>(A.rows()) - inverse.diagonal().dot(precision);
  return at;
}

}  // namespace armcal
