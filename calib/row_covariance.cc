#include "calib/row_covariance.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "calib/robust_rows.h"
#include "calib/score_covariance.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Lag-one autocorrelation of the worst joint's residuals.
double Autocorrelation(const VectorXd& x, const VectorXd& noise,
                       ResidualPass* pass) {
  const int n = static_cast<int>(noise.size());
  std::vector<ResidualStatistics> statistics(n);
  pass->Run("autocorrelation", x, noise, [&](const RowResidual& residual) {
    for (int i = 0; i < n; ++i) {
      if (!pass->uses(residual.log, i)) continue;
      if (!residual.follows) statistics[i].Break();
      statistics[i].Add(residual.r[i]);
    }
  });
  double rho = 0;
  for (const ResidualStatistics& s : statistics) {
    rho = std::max(rho, s.Autocorrelation());
  }
  return rho;
}

VectorXd Score(const RowResidual& residual, const LinearSolution& solution,
               const VectorXd& noise, bool huber,
               const ModelParameters& parameters) {
  VectorXd score = VectorXd::Zero(parameters.size());
  for (int i = 0; i < noise.size(); ++i) {
    const double r = residual.r[i];
    const double scale =
        solution.weight[i] * noise[i] * r * (huber ? Huber::Weight(r) : 1);
    const int begin = solution.own_block_only ? parameters.block_begin(i) : 0;
    const int size =
        solution.own_block_only ? parameters.block_size(i) : parameters.size();
    score.segment(begin, size) +=
        scale * residual.row.U.row(i).segment(begin, size).transpose();
  }
  return score;
}

// Standard deviations raised to the scatter of the logs' score sums (columns).
MatrixXd RaiseToLogScatter(const MatrixXd& covariance, const MatrixXd& gain,
                           const MatrixXd& sums) {
  const double logs = static_cast<double>(sums.cols());
  const MatrixXd between = gain * sums;
  VectorXd factor(covariance.rows());
  for (Eigen::Index k = 0; k < factor.size(); ++k) {
    const double variance = logs / (logs - 1) * between.row(k).squaredNorm();
    const double within = covariance(k, k);
    factor[k] = within > 0 ? std::sqrt(std::max(1.0, variance / within)) : 1;
  }
  return factor.asDiagonal() * covariance * factor.asDiagonal();
}

}  // namespace

CovarianceEstimate EstimateRowCovariance(const LinearSolution& solution,
                                         const VectorXd& noise, bool huber,
                                         const ReferenceMotion& reference,
                                         long rows, int hops_per_window,
                                         ResidualPass* pass) {
  const ModelParameters& parameters = pass->parameters();
  const int window =
      BartlettWindow(Autocorrelation(solution.x, noise, pass), rows,
                     hops_per_window + hops_per_window / 2);
  ScoreCovariance scores(parameters.size(), window);
  MatrixXd sums = MatrixXd::Zero(parameters.size(), pass->num_logs());
  BlockTriangularFactor inside(parameters);
  pass->Run("covariance", solution.x, noise, [&](const RowResidual& residual) {
    if (!residual.follows) scores.Break();
    const VectorXd score = Score(residual, solution, noise, huber, parameters);
    scores.Add(score);
    sums.col(residual.log) += score;
    for (int i = 0; huber && i < noise.size(); ++i) {
      if (!pass->uses(residual.log, i) || !Huber::Inside(residual.r[i])) {
        continue;
      }
      inside.Add(i, residual.row.U.row(i), residual.row.Y[i]);
    }
  });
  LinearSolution linearised = solution;
  if (huber) {  // the loss is only linear for residuals outside
    linearised.gain = SolveWeighted(inside, noise, reference).gain;
  }
  CovarianceEstimate estimate;
  estimate.covariance = linearised.CovarianceFromScores(scores.Value());
  estimate.method = "Newey-West over " + std::to_string(window) + " rows";
  if (pass->num_logs() >= 3) {
    estimate.covariance =
        RaiseToLogScatter(estimate.covariance, linearised.gain, sums);
    estimate.method += ", at least the scatter between logs";
  }
  return estimate;
}

}  // namespace armcal
