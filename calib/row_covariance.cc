#include "calib/row_covariance.h"

#include <algorithm>
#include <cmath>
#include <deque>
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

// What a Newey-West covariance of fitted residuals lacks: Bartlett's weights
// take some of the correlation that overlapping rows have for certain, and the
// fit has taken its share of the residuals. Both matter for short logs.
class SmallSampleFactor {
 public:
  explicit SmallSampleFactor(int lags) : products_(lags + 1, 0) {}

  void Add(const RowResidual& residual, const ResidualPass& pass) {
    if (!residual.follows) recent_.clear();
    VectorXd r = residual.r;
    for (int i = 0; i < r.size(); ++i) {
      r[i] *= Huber::Weight(r[i]);  // so that one outlier does not decide
      rows_ += pass.uses(residual.log, i);
    }
    recent_.push_front(r);
    if (recent_.size() > products_.size()) recent_.pop_back();
    for (size_t l = 0; l < recent_.size(); ++l) {
      products_[l] += r.dot(recent_[l]);
    }
  }
  // On a covariance by Bartlett's window, of m parameters.
  double Value(int window, int m) const {
    if (products_[0] <= 0) return 1;
    double whole = 1, weighted = 1, squares = 1;
    for (size_t l = 1; l < products_.size(); ++l) {
      const double rho = products_[l] / products_[0];
      const double weight = 1 - static_cast<double>(l) / window;
      whole += 2 * rho;
      weighted += 2 * std::max(0.0, weight) * rho;
      squares += 2 * rho * rho;
    }
    const double truncated =
        weighted > 0 ? std::clamp(whole / weighted, 1.0, 1.5) : 1;
    const double independent = rows_ / squares;
    return truncated * independent / std::max(independent - m, m / 2.0);
  }

 private:
  std::vector<double> products_;  // sums over rows of r(t) r(t - lag)
  std::deque<VectorXd> recent_;
  double rows_ = 0;
};

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

}  // namespace

MatrixXd RaiseToLogScatter(const MatrixXd& covariance, const MatrixXd& gain,
                           const MatrixXd& log_sums) {
  const double logs = static_cast<double>(log_sums.cols());
  if (logs < 3) return covariance;
  const MatrixXd between = gain * log_sums;
  VectorXd factor(covariance.rows());
  for (Eigen::Index k = 0; k < factor.size(); ++k) {
    const double variance = logs / (logs - 1) * between.row(k).squaredNorm();
    const double within = covariance(k, k);
    factor[k] = within > 0 ? std::sqrt(std::max(1.0, variance / within)) : 1;
  }
  return factor.asDiagonal() * covariance * factor.asDiagonal();
}

CovarianceEstimate EstimateRowCovariance(const LinearSolution& solution,
                                         const VectorXd& noise, bool huber,
                                         const ReferenceMotion& reference,
                                         long rows, int rows_per_window,
                                         ResidualPass* pass) {
  const ModelParameters& parameters = pass->parameters();
  const int window =
      BartlettWindow(Autocorrelation(solution.x, noise, pass), rows,
                     rows_per_window + rows_per_window / 2);
  ScoreCovariance scores(parameters.size(), window);
  MatrixXd sums = MatrixXd::Zero(parameters.size(), pass->num_logs());
  SmallSampleFactor small(rows_per_window - 1);
  BlockTriangularFactor inside(parameters);
  pass->Run("covariance", solution.x, noise, [&](const RowResidual& residual) {
    if (!residual.follows) scores.Break();
    const VectorXd score = Score(residual, solution, noise, huber, parameters);
    scores.Add(score);
    small.Add(residual, *pass);
    sums.col(residual.log) += score;
    for (int i = 0; solution.weighted && i < noise.size(); ++i) {
      // Outside, Huber's loss is only linear.
      if (huber && !Huber::Inside(residual.r[i])) continue;
      if (!pass->uses(residual.log, i)) continue;
      inside.Add(i, residual.row.U.row(i), residual.row.Y[i]);
    }
  });
  LinearSolution linearised = solution;
  if (solution.weighted) {
    linearised.gain = SolveWeighted(inside, noise, reference).gain;
  }
  CovarianceEstimate estimate;
  estimate.window = window;
  estimate.small_sample = small.Value(window, parameters.size());
  estimate.covariance = RaiseToLogScatter(
      estimate.small_sample * linearised.CovarianceFromScores(scores.Value()),
      linearised.gain, sums);
  estimate.method = "Newey-West over " + std::to_string(window) + " rows";
  if (pass->num_logs() >= 3) {
    estimate.method += ", at least the scatter between logs";
  }
  return estimate;
}

}  // namespace armcal
