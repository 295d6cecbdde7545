#include "calib/refine/trajectory_covariance.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "calib/linear/score_covariance.h"
#include "calib/numerics/residual_whiteness.h"
#include "calib/numerics/robust_rows.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBlock = 0.25;  // s, over which residuals are to be white

// By what standard deviations grow for errors that follow each other: the
// sandwich C S C with Newey-West's S of the scores, over C, never below 1. Only
// factors are taken, since a window holds too few scores to tell correlations
// of many parameters.
VectorXd LongRunFactor(const TrajectoryEstimate& estimate,
                       const MatrixXd& covariance, int window,
                       TrajectoryPass* pass) {
  ScoreCovariance scores(estimate.size(), window);
  pass->Gather("covariance", estimate, TorqueWeighting::kLinearised,
               [&](int, TrajectoryCorrection* stretch) {
                 scores.Break();
                 stretch->ForEachScore([&](const VectorXd& score) {
                   scores.Add({score.head(estimate.size()), {}, {}});
                 });
               });
  const MatrixXd long_run = covariance * scores.Value() * covariance;
  VectorXd factor = VectorXd::Ones(estimate.size());
  for (Eigen::Index k = 0; k < factor.size(); ++k) {
    if (!(covariance(k, k) > 0)) continue;
    factor[k] = std::sqrt(std::max(1.0, long_run(k, k) / covariance(k, k)));
  }
  return factor;
}

double Median(VectorXd x) {
  std::nth_element(x.begin(), x.begin() + x.size() / 2, x.end());
  return x[x.size() / 2];
}

}  // namespace

// V (V' A V)^-1 V' by Cholesky, V being `seen`. Its columns are of the size of
// standard deviations, so that V' A V is near 1 and well conditioned, which A
// is not.
std::optional<MatrixXd> InverseWithin(const MatrixXd& seen,
                                      const MatrixXd& information) {
  const Eigen::LLT<MatrixXd> inner(seen.transpose() * information * seen);
  if (inner.info() != Eigen::Success) return std::nullopt;
  const MatrixXd root = inner.matrixL().solve(seen.transpose());
  if (!root.allFinite()) return std::nullopt;
  return root.transpose() * root;
}

// Residuals decide which covariance is used. White ones have that of
// independent samples; Newey-West on white residuals would only add its own
// scatter to every deviation.
std::optional<TrajectoryCovariance> EstimateTrajectoryCovariance(
    const TrajectoryEstimate& estimate, const MatrixXd& seen,
    double least_window_s, TrajectoryPass* pass) {
  const int n = estimate.parameters.num_joints();
  ResidualWhiteness whiteness(n);
  std::vector<ResidualStatistics> statistics(n);
  const TrajectoryEquations equations = pass->Gather(
      "covariance", estimate, TorqueWeighting::kLinearised,
      [&](int, TrajectoryCorrection* stretch) {
        const MatrixXd& r = stretch->torque_residuals();
        whiteness.Add(
            r, std::max(4, static_cast<int>(kBlock / stretch->motion().dt)));
        for (int j = 0; j < n; ++j) {
          statistics[j].Break();
          for (const double z : r.col(j)) statistics[j].Add(z);
        }
      });
  const Eigen::Index m = estimate.x.size();
  const std::optional<MatrixXd> white =
      InverseWithin(seen, equations.information);
  if (!white) return std::nullopt;
  TrajectoryCovariance result;
  result.independent = white->topLeftCorner(m, m);
  result.estimate = {result.independent, "independent samples"};
  if (whiteness.IsWhite()) return result;
  double rho = 0;
  for (const auto& s : statistics) rho = std::max(rho, s.Autocorrelation());
  const int window =
      BartlettWindow(rho, statistics[0].count(),
                     static_cast<int>(least_window_s / pass->step_s()) + 1);
  const VectorXd factor = LongRunFactor(estimate, *white, window, pass).head(m);
  result.estimate = {
      factor.asDiagonal() * result.independent * factor.asDiagonal(),
      "Newey-West over " + std::to_string(window) + " samples"};
  result.inflation = Median(factor);
  return result;
}

}  // namespace armcal
