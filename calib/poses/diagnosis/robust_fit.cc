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

double PriorCost(const PoseEquations& equations, const PoseState& state) {
  return equations.FromFile(state).cwiseAbs2().dot(equations.Precision());
}

// Moves to a better state, and says by how much.
double Improve(const PoseEquations& equations,
               const std::vector<PoseTerm>& terms, double* damping,
               PoseEstimate* at) {
  const MatrixXd columns = equations.Columns(at->linear, terms);
  MatrixXd J(columns.rows(), at->linear.geometry.cols() + columns.cols());
  J << at->linear.geometry, columns;
  const MatrixXd A = PoseInformation(equations, *at, columns);
  VectorXd b =
      -WeightedRows(*at, J).transpose() * WeightedRows(*at, at->linear.r);
  b.head(equations.num_free()) -=
      equations.Precision().cwiseProduct(equations.FromFile(at->state));
  for (; *damping < 1e7; *damping *= 10) {
    MatrixXd damped = A;
    damped.diagonal() *= 1 + *damping;
    damped.diagonal().array() += 1e-12;
    const PoseState moved = equations.Moved(at->state, damped.ldlt().solve(b));
    const StudentFit errors = FitStudent(equations.Residuals(terms, moved),
                                         equations.width(), at->nu);
    const double prior = PriorCost(equations, moved);
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
  return A;
}

PoseEstimate EstimatePoses(const PoseEquations& equations,
                           const std::vector<PoseTerm>& terms, double nu,
                           const PoseState& start) {
  PoseEstimate at;
  at.nu = nu;
  at.state = start;
  at.linear = equations.Linearise(terms, start, false);
  at.errors = FitStudent(at.linear.r, equations.width(), nu);
  at.prior = PriorCost(equations, start);
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
