#include "calib/drive_gains/covariance.h"

#include <algorithm>
#include <string>
#include <vector>

#include "calib/linear/overlap_covariance.h"
#include "calib/linear/score_covariance.h"
#include "calib/numerics/posterior.h"
#include "calib/numerics/robust_rows.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// What a first pass finds, as EstimateRowCovariance has it.
struct CurrentStudy {
  // Of the worst joint's residuals, at the lag where rows no longer overlap.
  double autocorrelation = 0;
  MatrixXd gain;  // of equations, by the slope of the loss
};

CurrentStudy StudyCurrents(const GainFit& fit, RobustLoss loss,
                           int rows_per_window, CurrentPass* pass) {
  std::vector<ResidualStatistics> statistics(
      fit.noise.size(), ResidualStatistics(rows_per_window));
  const auto curvature = [loss](double r) {
    return InformingSlope(EvaluateLoss(loss, r));
  };
  const CurrentFactors inside =
      pass->Factors("autocorrelation", fit.estimate, fit.noise, curvature,
                    [&](const CurrentRow& row) {
                      for (int i = 0; i < fit.noise.size(); ++i) {
                        if (!row.follows) statistics[i].Break();
                        if (fit.noise[i] > 0) statistics[i].Add(row.r[i]);
                      }
                    });
  CurrentStudy study;
  for (const ResidualStatistics& s : statistics) {
    study.autocorrelation =
        std::max(study.autocorrelation, s.Autocorrelation());
  }
  study.gain = GainSensitivity(WhitenedEquations(inside, fit.noise), pass->B(),
                               fit.estimate, fit.reference)
                   .Gain();
  return study;
}

// Gradients of every joint's current by (g, x, p), in units of its noise.
MatrixXd Jacobian(const CurrentRow& row, const GainEstimate& estimate,
                  const VectorXd& noise, const MatrixXd& B) {
  const Eigen::Index n = noise.size(), m = estimate.x.size();
  const VectorXd x =
      row.loaded ? VectorXd(estimate.x + B * estimate.p) : estimate.x;
  MatrixXd J = MatrixXd::Zero(n, n + m + 10);
  for (int i = 0; i < n; ++i) {
    if (noise[i] <= 0) continue;
    const auto u = row.row.U.row(i) / noise[i];
    J(i, i) = u.dot(x);
    J.row(i).segment(n, m) = estimate.g[i] * u;
    if (row.loaded) J.row(i).tail<10>() = estimate.g[i] * (u * B);
  }
  return J;
}

// Equations in units of noise: U are the gradients of the currents.
FittedRow MakeFittedRow(const CurrentRow& row, const GainFit& fit,
                        RobustLoss loss, const MatrixXd& B) {
  FittedRow fitted{Jacobian(row, fit.estimate, fit.noise, B), row.r, {}, row.r};
  fitted.U.col(fit.reference).setZero();  // is known
  for (int i = 0; i < row.r.size(); ++i) {
    fitted.used.push_back(fit.noise[i] > 0);
    const LossAt at = EvaluateLoss(loss, row.r[i]);
    fitted.slope[i] = InformingSlope(at);
    fitted.r[i] *= at.weight;
  }
  return fitted;
}

Score GainScore(const FittedRow& row) {
  return {row.U.transpose() * row.r, row.U, row.slope.asDiagonal() * row.U};
}

}  // namespace

CovarianceEstimate EstimateGainCovariance(const GainFit& fit, RobustLoss loss,
                                          const MatrixXd& D,
                                          int rows_per_window,
                                          CurrentPass* pass) {
  const CurrentStudy study = StudyCurrents(fit, loss, rows_per_window, pass);
  const int size = static_cast<int>(D.rows());
  const int joints = static_cast<int>(fit.noise.size());
  CovarianceEstimate result;
  result.rows_per_window = rows_per_window;
  result.window = std::max(
      rows_per_window + rows_per_window / 2,
      rows_per_window * BartlettWindow(study.autocorrelation,
                                       fit.equations / rows_per_window, 1));
  ScoreCovariance scores(size, result.window, study.gain);
  OverlapCovariance overlap(joints, size, rows_per_window);
  MatrixXd sums = MatrixXd::Zero(size, pass->num_logs());
  pass->Run("covariance", fit.estimate, fit.noise, [&](const CurrentRow& row) {
    if (!row.follows) scores.Break(), overlap.Break();
    const FittedRow fitted = MakeFittedRow(row, fit, loss, pass->B());
    const Score score = GainScore(fitted);
    scores.Add(score);
    overlap.Add(fitted);
    sums.col(row.log) += score.value;
  });
  const MatrixXd reach = D.transpose() * study.gain;
  const MatrixXd least =
      D.transpose() * overlap.Value(study.gain, VectorXd::Ones(joints)) * D;
  result.covariance = RaiseToLogScatter(
      RaiseTo(least.diagonal(), Sandwich(reach, scores.Value())), reach, sums);
  result.method =
      "Newey-West over " + std::to_string(result.window) + " rows" +
      (pass->num_logs() >= 3 ? ", at least the scatter between logs" : "");
  return result;
}

}  // namespace armcal
