#include "calib/linear/factor_solution.h"

#include <algorithm>
#include <cmath>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Solves with weights from re-estimated noise. Equations without a drive torque
// (frozen) are homogeneous, U x = 0: the smaller x, the smaller their residual,
// and weights that followed it would lead to an arm without mass. So the other
// joints find x first, the frozen joints' noise is what their equations have
// there, and it is kept.
LinearSolution SolveByNoise(const BlockTriangularFactor& factor,
                            const ReferenceScale& reference,
                            const std::vector<bool>& frozen, VectorXd* noise) {
  *noise = RightSideRms(factor);
  for (size_t i = 0; i < frozen.size(); ++i) {
    if (frozen[i]) (*noise)[i] = 0;
  }
  const LinearSolution powered =
      SolveReweighted(factor, reference, frozen, noise);
  const VectorXd estimate = EstimateNoise(factor, powered.x);
  for (size_t i = 0; i < frozen.size(); ++i) {
    if (frozen[i]) (*noise)[i] = estimate[i];
  }
  return SolveReweighted(factor, reference, frozen, noise);
}

}  // namespace

// The reference motion has the speed and the frequency of the logs, so that a
// column is judged as what a rich motion like theirs would make of it.
ReferenceScale MakeReference(const ModelParameters& parameters,
                             const RowOptions& rows, double motion_hz,
                             const LogFactors& factors) {
  double speed = std::sqrt(factors.mean_square_speed().maxCoeff());
  if (speed < 1e-3) speed = 1;
  double unit = 1;
  if (rows.identification == Identification::kIntegral) {
    unit = rows.intervals.empty() ? rows.interval_s : 0;
    for (const TimeRange& r : rows.intervals) {
      unit = std::max(unit, r.end - r.begin);
    }
  }
  return MakeReferenceScale(
      parameters, speed, std::max(0.1, motion_hz), unit,
      RightSideRms(factors.Merged(parameters, FindNonzero(factors))),
      parameters.nominal());
}

// The recursion needs the ranks of its blocks (2.30), which need the noise,
// which needs a solution: the batch's, which asks for less.
LinearSolution SolveFactor(const BlockTriangularFactor& factor,
                           const ReferenceScale& reference,
                           const std::vector<bool>& frozen, LinearSolver solver,
                           LinearCalibration* result) {
  LinearSolution solution;
  if (solver == LinearSolver::kWeighted) {
    solution = SolveByNoise(factor, reference, frozen, &result->noise);
  } else {
    solution = SolveBatch(factor, reference);
    result->noise = EstimateNoise(factor, solution.x);
  }
  result->identifiability = AnalyzeIdentifiability(factor, result->parameters,
                                                   result->noise, reference);
  if (solver == LinearSolver::kRecursive) {
    solution = SolveRecursive(factor, result->identifiability);
    if (solution.solved) result->noise = EstimateNoise(factor, solution.x);
  }
  result->solved = solution.solved && solution.x.allFinite();
  result->reason = !solution.solved  ? solution.refusal
                   : !result->solved ? "the numbers of the logs overflow"
                                     : "solved";
  return solution;
}

void AddScaleCovariance(const LinearSolution& solution,
                        LinearCalibration* result) {
  const MatrixXd by_scale = result->torque_constants_stddev * solution.by_scale;
  result->scale_covariance = by_scale * by_scale.transpose();
  result->covariance += result->scale_covariance;
  for (Eigen::Index k = 0; k < result->x.size(); ++k) {
    if (!result->identifiable[k]) continue;
    result->stddev[k] = std::sqrt(result->covariance(k, k));
  }
}

double MedianInflation(const MatrixXd& covariance,
                       const MatrixXd& independent) {
  std::vector<double> ratios;
  for (Eigen::Index k = 0; k < covariance.rows(); ++k) {
    if (!(independent(k, k) > 0)) continue;
    ratios.push_back(std::sqrt(covariance(k, k) / independent(k, k)));
  }
  if (ratios.empty()) return 1;
  std::nth_element(ratios.begin(), ratios.begin() + ratios.size() / 2,
                   ratios.end());
  return std::max(1.0, ratios[ratios.size() / 2]);
}

}  // namespace armcal
