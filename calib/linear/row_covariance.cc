#include "calib/linear/row_covariance.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "calib/linear/overlap_covariance.h"
#include "calib/linear/score_covariance.h"
#include "calib/numerics/posterior.h"
#include "calib/numerics/robust_rows.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// What the first pass over the rows finds.
struct RowStudy {
  // Of the worst joint's residuals, at the lag where rows no longer overlap.
  double autocorrelation = 0;
  // Equations by InformingSlope. Where the loss gives a residual up the true
  // one is negative: its mean tells what a joint's equations inform, which
  // `slope` has as a share of what these have.
  BlockTriangularFactor sloping;
  VectorXd slope;
};

// The first pass: it takes the residuals' autocorrelation, for the window, and
// the matrix A = sum psi'(r) u'u of the sandwich A^-1 B A^-1 of an M-estimate
// (Huber 1967; White 1980, Econometrica 48). A is a triangular factor of rows
// times sqrt(psi'). psi' of losses that give up is negative in places and has
// no root, so that rows have InformingSlope and each joint the mean ratio of
// both.
RowStudy StudyRows(const LinearSolution& solution, const VectorXd& noise,
                   RobustLoss loss, int rows_per_window, ResidualPass* pass) {
  const int n = static_cast<int>(noise.size());
  std::vector<TriangularFactor> sloping = EmptyFactors(pass->parameters());
  VectorXd slopes = VectorXd::Zero(n), informing = slopes;
  std::vector<ResidualStatistics> statistics(
      n, ResidualStatistics(rows_per_window));
  pass->RunBatches(
      "autocorrelation", solution.x, noise, [&](const BatchResidual& batch) {
        VectorXd weights(batch.rows.count);
        for (int i = 0; i < n; ++i) {
          if (!pass->uses(batch.log, i)) continue;
          if (!batch.follows) statistics[i].Break();
          for (long k = 0; k < batch.rows.count; ++k) {
            statistics[i].Add(batch.r(k, i));
            const LossAt at = EvaluateLoss(loss, batch.r(k, i));
            slopes[i] += at.slope;
            informing[i] += InformingSlope(at);
            weights[k] = std::sqrt(InformingSlope(at));
          }
          const JointColumns& columns = batch.rows.columns;
          sloping[i].AddRows(columns.column(i, 0), columns.stride(),
                             batch.rows.count, weights.data());
        }
      });
  RowStudy study{0, BlockTriangularFactor(pass->parameters(), sloping), {}};
  for (const ResidualStatistics& s : statistics) {
    study.autocorrelation =
        std::max(study.autocorrelation, s.Autocorrelation());
  }
  study.slope = slopes.cwiseQuotient(informing.cwiseMax(1e-300)).cwiseMax(.1);
  return study;
}

FittedRow MakeFittedRow(const RowResidual& residual, RobustLoss loss,
                        const RowStudy& study, const ResidualPass& pass) {
  FittedRow row{residual.row.U, residual.r, {}, study.slope};
  for (int i = 0; i < row.r.size(); ++i) {
    const LossAt at = EvaluateLoss(loss, residual.r[i]);
    row.used.push_back(pass.uses(residual.log, i));
    row.slope[i] *= InformingSlope(at);
    row.r[i] *= at.weight;
  }
  return row;
}

// A row's score sum_i w_i noise_i psi(r_i) u_i', whose sum over rows is 0 at
// the solution. C and U are what ScoreCovariance needs for the part that the
// fit took.
Score MakeScore(const FittedRow& row, const LinearSolution& solution,
                const VectorXd& noise, const ModelParameters& parameters) {
  const Eigen::Index n = noise.size(), m = parameters.size();
  Score score{VectorXd::Zero(m), MatrixXd::Zero(n, m), MatrixXd::Zero(n, m)};
  for (int i = 0; i < n; ++i) {
    if (!row.used[i]) continue;
    const int begin = solution.own_block_only ? parameters.block_begin(i) : 0;
    const int size =
        solution.own_block_only ? parameters.block_size(i) : parameters.size();
    const VectorXd c =
        solution.weight[i] * row.U.row(i).segment(begin, size).transpose();
    score.value.segment(begin, size) += noise[i] * row.r[i] * c;
    score.C.row(i).segment(begin, size) = c.transpose();
    score.U.row(i) = row.slope[i] * row.U.row(i);
  }
  return score;
}

}  // namespace

// The scatter of L logs about their common solution,
//   L / (L - 1) sum_l (G s_l)^2,   s_l being the sum of log l's scores:
// errors may be as dependent as they like within a log (Liang & Zeger 1986,
// Biometrika 73, for clusters). With few logs it is itself uncertain, so that
// it only raises what the rows tell.
MatrixXd RaiseToLogScatter(const MatrixXd& covariance, const MatrixXd& gain,
                           const MatrixXd& log_sums) {
  const double logs = static_cast<double>(log_sums.cols());
  if (logs < 3) return covariance;
  const MatrixXd between = gain * log_sums;
  return RaiseTo(logs / (logs - 1) * between.rowwise().squaredNorm(),
                 covariance);
}

// The covariance G B G' of a solution x - X = G sum of scores. B is the
// long-run covariance of the scores, sum_l E s(t) s(t + l)', of which scores
// that overlap or follow slow errors have many terms. Newey & West (1987,
// Econometrica 55) weigh the lags by 1 - |l| / window, which keeps B positive
// semidefinite; Andrews (1991, Econometrica 59) tells how wide. (U' W U)^-1,
// which takes rows for independent, would have deviations that shrink with the
// number of windows cut from the same second of motion.
//
// Three estimates are combined, because each fails otherwise: Newey-West is
// biased low with few windows; OverlapCovariance takes errors for alike at all
// times; the scatter of logs needs several of them. Deviations are the largest
// of the three.
CovarianceEstimate EstimateRowCovariance(const LinearSolution& solution,
                                         const VectorXd& noise, RobustLoss loss,
                                         const ReferenceScale& reference,
                                         const MatrixXd& wanted, long rows,
                                         int rows_per_window,
                                         ResidualPass* pass) {
  const int m = pass->parameters().size();
  const RowStudy study =
      StudyRows(solution, noise, loss, rows_per_window, pass);
  LinearSolution linearised = solution;
  if (solution.weighted) {
    linearised.gain =
        SolveWeighted(study.sloping,
                      noise.cwiseQuotient(study.slope.cwiseSqrt()), reference)
            .gain;
  }
  CovarianceEstimate estimate;
  estimate.rows_per_window = rows_per_window;
  // Andrews' window for what rows that do not overlap still share.
  estimate.window =
      std::max(rows_per_window + rows_per_window / 2,
               rows_per_window * BartlettWindow(study.autocorrelation,
                                                rows / rows_per_window, 1));
  ScoreCovariance scores(m, estimate.window, linearised.gain);
  OverlapCovariance overlap(static_cast<int>(noise.size()), m, rows_per_window);
  MatrixXd sums = MatrixXd::Zero(m, pass->num_logs());
  pass->Run("covariance", solution.x, noise, [&](const RowResidual& residual) {
    if (!residual.follows) scores.Break(), overlap.Break();
    const FittedRow row = MakeFittedRow(residual, loss, study, *pass);
    const Score score = MakeScore(row, solution, noise, pass->parameters());
    scores.Add(score);
    overlap.Add(row);
    sums.col(residual.log) += score.value;
  });
  const MatrixXd gain = wanted * linearised.gain;
  MatrixXd covariance = Sandwich(gain, scores.Value());
  if (!solution.own_block_only) {
    const VectorXd scale = solution.weight.cwiseProduct(noise);
    const MatrixXd least = overlap.Value(linearised.gain, scale);
    covariance =
        RaiseTo((wanted * least * wanted.transpose()).diagonal(), covariance);
  }
  estimate.covariance = RaiseToLogScatter(covariance, gain, sums);
  estimate.method =
      "Newey-West over " + std::to_string(estimate.window) + " rows";
  if (pass->num_logs() >= 3) {
    estimate.method += ", at least the scatter between logs";
  }
  return estimate;
}

}  // namespace armcal
