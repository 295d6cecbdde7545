#include "calib/closed_loop/windows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "calib/closed_loop/noise.h"
#include "calib/logs/position_noise.h"
#include "calib/numerics/leaf_factor.h"
#include "calib/numerics/triangular_factor.h"
#include "problems/make_rows.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// How far a window's start may be from what the log shows of it, rad and rad/s
// (m and m/s), and the integral from 0, in torques of an error of that many
// rad: next to nothing, but finite.
constexpr double kStartPosition = .01, kStartVelocity = 1, kStartIntegral = 1;
constexpr double kLeadIn = 1;  // s
// How many probes estimate a trace. Of a loop that resonates a few tell little.
constexpr int kProbes = 16;
constexpr double kScoreBlock = 1;  // s, longer than errors of friction last

// Deviations of the encoders' noise; of a log without any, something beside
// its motion.
VectorXd NoiseOf(const Log& log) {
  constexpr double kLeast = 1e-7;  // of the range
  return PositionNoise(log.q).cwiseMax(
      (kLeast * (log.q.colwise().maxCoeff() - log.q.colwise().minCoeff()))
          .transpose()
          .cwiseMax(1e-9));
}

// Adds a window's scores, weights' residuals, second by second.
void AddScores(const VectorXd& t, const MatrixXd& weights,
               const VectorXd& residual, MatrixXd* sums) {
  const long n = residual.size() / t.size();
  for (long first = 0; first < t.size();) {
    long last = first;
    while (last < t.size() && t[last] < t[first] + kScoreBlock) ++last;
    const long rows = n * (last - first);
    sums->conservativeResize(sums->rows() + 1, weights.cols());
    sums->bottomRows(1) = residual.segment(n * first, rows).transpose() *
                          weights.middleRows(n * first, rows);
    first = last;
  }
}

}  // namespace

double LoopRun::Excess() const {
  double rows = 0;
  for (const VectorXd& residual : residuals) {
    rows += static_cast<double>(residual.size());
  }
  return std::sqrt(cost / rows);
}

LoopWindows::LoopWindows(const Robot& known,
                         const ControllerOptions& controller, double window_s,
                         const std::vector<CommandedLog>& logs)
    : LoopWindows(controller, logs, known.num_joints()) {
  noise_ = VectorXd::Zero(n_);
  for (size_t l = 0; l < logs.size(); ++l) {
    references_.push_back(std::make_shared<CommandedReference>(
        known, controller.feedforward, logs[l]));
    noise_ += NoiseOf(logs[l].log).cwiseAbs2();
    AddWindows(static_cast<int>(l), window_s, 1);
  }
  noise_ = (noise_ / std::max<size_t>(1, logs.size())).cwiseSqrt();
}

LoopWindows LoopWindows::Thinned(double window_s, int every) const {
  LoopWindows thinned(controller_, logs_, n_);
  thinned.references_ = references_;
  thinned.noise_ = noise_;
  for (size_t l = 0; l < logs_.size(); ++l) {
    thinned.AddWindows(static_cast<int>(l), window_s, every);
  }
  return thinned;
}

// Cuts a log into windows of equal length, about `window_s`: multiple shooting
// (Bock & Plitt 1984, IFAC World Congress). A simulation of the whole log would
// carry an early error on to its end, and would be far from linear in the
// values.
void LoopWindows::AddWindows(int log, double window_s, int every) {
  const VectorXd& t = logs_[log].log.t;
  const long size = t.size();
  const double duration = t[size - 1];
  const auto count =
      static_cast<long>(std::max(1., std::round(duration / window_s)));
  long first = 0;
  for (long k = 0; k < count; ++k) {
    const double end = duration * static_cast<double>(k + 1) / count;
    long last = first;
    while (last < size && (k + 1 == count || t[last] < end)) ++last;
    const long begin = first;
    first = last;
    if (k % every != 0) continue;
    const LoopStretch stretch(logs_[log].log, *references_[log], begin,
                              last - begin, 1 / controller_.rate_hz);
    const LoopStart shown = stretch.Start();
    VectorXd nominal(3 * n_);
    nominal << shown.q, shown.qd, shown.integral;
    windows_.push_back({log, stretch, nominal, nominal});
  }
}

// All windows at once, since lanes of a register hold different windows.
LoopRun LoopWindows::Simulate(const LoopValues& values) const {
  std::vector<const LoopStretch*> stretches;
  std::vector<LoopStart> starts;
  for (const Window& w : windows_) {
    stretches.push_back(&w.stretch);
    starts.push_back(
        {w.start.head(n_), w.start.segment(n_, n_), w.start.tail(n_)});
  }
  LoopRun run;
  run.tracks = SimulateLoop(controller_, values, stretches, starts);
  VectorXd squares = VectorXd::Zero(n_);
  long periods = 0;
  for (size_t k = 0; k < windows_.size(); ++k) {
    const LoopTrack& track = run.tracks[k];
    run.finite = run.finite && track.finite;
    run.residuals.push_back(track.Residual(*stretches[k]));
    run.cost += RowScale(stretches[k]->num_rows())
                    .cwiseProduct(run.residuals[k])
                    .squaredNorm() +
                StartCost(windows_[k]);
    squares += track.torque_squares;
    periods += stretches[k]->num_periods();
  }
  run.torque_rms = (squares / static_cast<double>(periods)).cwiseSqrt();
  return run;
}

// A start's integral is in torque, whose scale is the drive's stiffness.
VectorXd LoopWindows::StartPrior() const {
  VectorXd prior(3 * n_);
  prior.head(n_).setConstant(kStartPosition);
  prior.segment(n_, n_).setConstant(kStartVelocity);
  for (int j = 0; j < n_; ++j) {
    // Without an integral part it is an offset of the joint for ever.
    const DriveLaw& drive = controller_.drives[j];
    const double stiffness = drive.kp + drive.kd * drive.position_gain;
    prior[2 * n_ + j] = drive.ki > 0 || drive.velocity_ki > 0
                            ? kStartIntegral * std::max(stiffness, 1e-9)
                            : 1e-9;
  }
  return prior;
}

double LoopWindows::StartCost(const Window& w) const {
  return (w.nominal - w.start).cwiseQuotient(StartPrior()).squaredNorm();
}

VectorXd LoopWindows::RowScale(long rows) const {
  return noise_.cwiseInverse().replicate(rows, 1);
}

// The triangle of start, columns and residual. With the start's columns first,
// the rows below them are what is left for the values with the start eliminated
// (QR as in link_equations.cc), and those of the start give it back when the
// values are known.
LoopEquations::Window LoopWindows::Reduce(const Window& w,
                                          const LoopTangent& tangent,
                                          const VectorXd& residual) const {
  const long s = 3 * n_, p = tangent.by_columns.cols() - s;
  const VectorXd scale = RowScale(w.stretch.num_rows());
  MatrixXd rows(residual.size(), s + p + 1);
  rows.leftCols(s) = scale.asDiagonal() * tangent.by_columns.rightCols(s);
  rows.middleCols(s, p) = scale.asDiagonal() * tangent.by_columns.leftCols(p);
  rows.rightCols(1) = scale.cwiseProduct(residual);
  MatrixXd ties = MatrixXd::Zero(s, s + p + 1);
  const VectorXd prior = StartPrior().cwiseInverse();
  ties.leftCols(s) = prior.asDiagonal();
  ties.rightCols(1) = prior.cwiseProduct(w.nominal - w.start);
  TriangularFactor factor(static_cast<int>(s + p));
  factor.AddRows(rows.data(), rows.rows(), rows.rows());
  factor.AddRows(ties.data(), ties.rows(), ties.rows());
  return {w.start, factor.Triangle()};
}

// Gauss-Newton's equations of all windows, their starts eliminated one by one:
// the size of R does not grow with the number of windows.
LoopEquations LoopWindows::Linearise(const LoopValues& values,
                                     const LoopColumns& columns,
                                     const LoopRun& run) const {
  const int p = columns.num_values();
  LoopEquations all;
  MatrixXd triangle;
  for (size_t k = 0; k < windows_.size(); ++k) {
    const Window& w = windows_[k];
    const LoopTangent tangent = LineariseLoop(controller_, values, columns,
                                              w.stretch, run.tracks[k], false);
    all.windows.push_back(Reduce(w, tangent, run.residuals[k]));
    const MatrixXd values_only =
        all.windows.back().triangle.bottomRightCorner(p + 1, p + 1);
    triangle = triangle.size() == 0 ? values_only
                                    : MergeTriangles(triangle, values_only);
  }
  all.R = triangle.topLeftCorner(p, p) * columns.spread();
  all.z = triangle.topRightCorner(p, 1);
  return all;
}

// Back substitution: the start that goes with a step of the values.
void LoopWindows::Move(const LoopColumns& columns,
                       const LoopEquations& equations, const VectorXd& dx,
                       double share) {
  const VectorXd by_column = columns.spread() * dx;
  const long s = 3 * n_, p = by_column.size();
  for (size_t k = 0; k < windows_.size(); ++k) {
    const auto& [start, triangle] = equations.windows[k];
    const VectorXd rest =
        triangle.col(s + p).head(s) - triangle.block(0, s, s, p) * by_column;
    windows_[k].start =
        start +
        share *
            triangle.topLeftCorner(s, s).triangularView<Eigen::Upper>().solve(
                rest);
  }
}

// The scores' covariance as far as it is encoder noise's. Their weights are the
// columns with the start eliminated. Noise also makes a sum of squares, E
// |r|^2, the trace of the residuals' covariance: the mean of (s'r)^2 over
// random signs s has it without the matrix (Hutchinson 1990, Commun. Statist.
// Simul. 19). Residuals of a whole log follow each other; its windows' do not,
// but for the moment that a loop takes to forget.
LoopScores LoopWindows::Scores(const LoopValues& values,
                               const LoopColumns& columns, const LoopRun& run,
                               const LoopEquations& equations) const {
  const int p = columns.num_values(), s = 3 * n_;
  LoopScores all;
  MatrixXd covariance = MatrixXd::Zero(p, p), sums;
  std::mt19937 random(1);
  for (size_t l = 0; l < windows_.size(); ++l) {
    const LoopStretch& stretch = windows_[l].stretch;
    const MatrixXd& triangle = equations.windows[l].triangle;
    const LoopTangent tangent = LineariseLoop(controller_, values, columns,
                                              stretch, run.tracks[l], true);
    const VectorXd& residual = run.residuals[l];
    const VectorXd scale = RowScale(stretch.num_rows());
    // Scores' weights, free of the start; and signs, whose squares have the
    // trace in the mean.
    MatrixXd weights(residual.size(), p + kProbes);
    const MatrixXd start_of_values =
        triangle.topLeftCorner(s, s).triangularView<Eigen::Upper>().solve(
            triangle.block(0, s, s, p));
    weights.leftCols(p) = tangent.by_columns.leftCols(p) -
                          tangent.by_columns.rightCols(s) * start_of_values;
    weights.leftCols(p) = scale.cwiseAbs2().asDiagonal() * weights.leftCols(p);
    for (long k = 0; k < weights.rows(); ++k) {
      for (int probe = 0; probe < kProbes; ++probe) {
        weights(k, p + probe) = (random() & 1) != 0 ? scale[k] : -scale[k];
      }
    }
    const MatrixXd sum =
        LoopNoiseCovariance(controller_, values, stretch, run.tracks[l],
                            tangent.periods, noise_, weights);
    covariance += sum.topLeftCorner(p, p);
    all.expected_squares += sum.diagonal().tail(kProbes).mean();
    AddScores(stretch.log().t.segment(stretch.first_row(), stretch.num_rows()),
              weights.leftCols(p), residual, &sums);
    all.residual_squares += scale.cwiseProduct(residual).squaredNorm();
  }
  const MatrixXd& spread = columns.spread();
  all.covariance = spread.transpose() * covariance * spread;
  all.sums = sums * spread;
  return all;
}

void LoopWindows::ForEachRow(const VisitRow& visit) const {
  for (size_t w = 0; w < windows_.size(); ++w) {
    const LoopStretch& stretch = windows_[w].stretch;
    const CommandedLog& log = logs_[windows_[w].log];
    const VectorXd& t = log.log.t;
    const long first = stretch.first_row();
    for (long k = 0; k < stretch.num_rows(); ++k) {
      visit(log, first + k, w, k, t[first + k] >= t[first] + kLeadIn);
    }
  }
}

VectorXd LoopWindows::ResidualRms(const LoopRun& run) const {
  if (!run.finite) {
    return VectorXd::Constant(n_, std::numeric_limits<double>::infinity());
  }
  VectorXd squares = VectorXd::Zero(n_);
  long count = 0;
  ForEachRow(
      [&](const CommandedLog&, long, size_t window, long row, bool counts) {
        if (!counts) return;
        squares += run.residuals[window].segment(n_ * row, n_).cwiseAbs2();
        ++count;
      });
  return (squares / static_cast<double>(std::max(1L, count))).cwiseSqrt();
}

}  // namespace armcal
