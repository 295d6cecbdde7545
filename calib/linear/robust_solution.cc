#include "calib/linear/robust_solution.h"

#include <algorithm>
#include <cmath>

#include "calib/numerics/robust_rows.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

// Iteratively reweighted least squares (Holland & Welsch 1977, Comm. Statist.
// A6). A pass weighs each row by psi(r) / r of its residual at the last
// solution, factors the weighted rows and solves. The noise is 1.4826 times the
// median of |r|, which half of the rows being wrong cannot move far, while a
// rms would grow with the outliers and hide them. Huber's loss is convex and
// converges from anywhere; one that gives residuals up has several minima and
// therefore begins at Huber's solution.
void Iterate(RobustLoss loss, const VectorXd& least,
             const std::vector<bool>& frozen, const ReferenceScale& reference,
             ResidualPass* pass, RobustSolution* result) {
  constexpr int kMostPasses = 20;
  constexpr double kSettled = 0.1;  // standard deviations
  const int n = static_cast<int>(least.size());
  for (int k = 0; k < kMostPasses; ++k) {
    std::vector<TriangularFactor> factors = EmptyFactors(pass->parameters());
    std::vector<ResidualStatistics> statistics(n);
    pass->RunBatches("robust weights", result->solution.x, result->noise,
                     [&](const BatchResidual& batch) {
                       VectorXd weights(batch.rows.count);
                       for (int i = 0; i < n; ++i) {
                         if (!pass->uses(batch.log, i)) continue;
                         for (long k = 0; k < batch.rows.count; ++k) {
                           const double r = batch.r(k, i);
                           statistics[i].Add(r);
                           weights[k] = std::sqrt(EvaluateLoss(loss, r).weight);
                         }
                         const JointColumns& columns = batch.rows.columns;
                         factors[i].AddRows(columns.column(i, 0),
                                            columns.stride(), batch.rows.count,
                                            weights.data());
                       }
                     });
    const BlockTriangularFactor factor(pass->parameters(), factors);
    result->outliers.clear();
    for (int i = 0; i < n; ++i) {
      result->outliers.push_back(statistics[i].outliers());
      const double spread = statistics[i].RobustSpread();
      if (frozen[i]) continue;
      result->noise[i] = std::max(least[i], result->noise[i] * spread);
    }
    const VectorXd last = result->solution.x;
    result->solution = SolveWeighted(factor, result->noise, reference);
    // The gain of weighted least squares is the covariance of independent rows.
    const double moved =
        (result->solution.x - last)
            .cwiseAbs()
            .cwiseQuotient(
                result->solution.gain.diagonal().cwiseSqrt().cwiseMax(1e-300))
            .maxCoeff();
    if (k > 0 && moved < kSettled) break;
  }
}

}  // namespace

RobustSolution SolveRobust(const VectorXd& x, const VectorXd& noise,
                           const std::vector<bool>& frozen, RobustLoss loss,
                           const ReferenceScale& reference,
                           ResidualPass* pass) {
  // Where a joint's equations can be solved exactly, their spread falls pass
  // after pass, until nothing else counts beside them.
  const VectorXd least = 1e-3 * noise;
  RobustSolution result;
  result.solution.x = x;
  result.noise = noise;
  Iterate(RobustLoss::kHuber, least, frozen, reference, pass, &result);
  if (loss != RobustLoss::kHuber) {
    Iterate(loss, least, frozen, reference, pass, &result);
  }
  return result;
}

}  // namespace armcal
