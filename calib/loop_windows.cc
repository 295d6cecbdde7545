#include "calib/loop_windows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "calib/leaf_factor.h"
#include "calib/loop_noise.h"
#include "calib/position_noise.h"
#include "calib/triangular_factor.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Wanted = PositionLoop::Wanted;

// How far a window's start may be from what the log shows of it, rad and rad/s
// (m and m/s), and the integral from 0, in torques of an error of that many
// rad: next to nothing, but finite.
constexpr double kStartPosition = .01, kStartVelocity = 1, kStartIntegral = 1;
constexpr double kCatchUp = 1;     // s
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

LoopWindows::LoopWindows(const Robot& known,
                         const ControllerOptions& controller, double window_s,
                         const std::vector<CommandedLog>& logs)
    : controller_(controller), logs_(logs), n_(known.num_joints()) {
  noise_ = VectorXd::Zero(n_);
  for (size_t l = 0; l < logs.size(); ++l) {
    references_.push_back(std::make_unique<CommandedReference>(
        known, controller.feedforward, logs[l]));
    loops_.push_back(std::make_unique<PositionLoop>(
        controller_, *references_.back(), logs[l].log));
    noise_ += NoiseOf(logs[l].log).cwiseAbs2();
    AddWindows(static_cast<int>(l), window_s);
  }
  noise_ = (noise_ / std::max<size_t>(1, logs.size())).cwiseSqrt();
}

// Windows of equal length, about `window_s`.
void LoopWindows::AddWindows(int log, double window_s) {
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
    Window window{log, first, last - first, loops_[log]->StartAt(first), {}};
    window.start.resize(3 * n_);
    window.start << window.nominal.q, window.nominal.qd,
        window.nominal.integral;
    windows_.push_back(window);
    first = last;
  }
}

LoopStart LoopWindows::StartOf(const VectorXd& start) const {
  return {start.head(n_), start.segment(n_, n_), start.tail(n_)};
}

VectorXd LoopWindows::StartPrior() const {
  VectorXd prior(3 * n_);
  prior.head(n_).setConstant(kStartPosition);
  prior.segment(n_, n_).setConstant(kStartVelocity);
  for (int j = 0; j < n_; ++j) {
    // Without an integral part it is an offset of the joint for ever.
    const DriveLaw& drive = controller_.drives[j];
    prior[2 * n_ + j] =
        drive.ki > 0 ? kStartIntegral * std::max(drive.kp, 1e-9) : 1e-9;
  }
  return prior;
}

VectorXd LoopWindows::RowScale(long rows) const {
  return noise_.cwiseInverse().replicate(rows, 1);
}

LoopEquations LoopWindows::Linearise(const LoopValues& values,
                                     const Progress& progress) const {
  const LoopColumns columns(n_);
  const int p = columns.num_values(), s = 3 * n_;
  LoopEquations all;
  all.torque_rms = VectorXd::Zero(n_);
  MatrixXd triangle;
  long periods = 0;
  double done = 0;
  for (const Window& w : windows_) {
    if (progress) progress("simulating", done / windows_.size());
    done += 1;
    const LoopRun run = loops_[w.log]->Run(values, StartOf(w.start), w.first,
                                           w.rows, Wanted::kTangents);
    all.finite = run.finite;
    if (!run.finite) return all;
    const VectorXd scale = RowScale(w.rows);
    MatrixXd rows(n_ * w.rows, s + p + 1);
    rows.leftCols(s) = scale.asDiagonal() * run.by_values.rightCols(s);
    rows.middleCols(s, p) = scale.asDiagonal() * run.by_values.leftCols(p);
    rows.rightCols(1) = scale.cwiseProduct(run.residual);
    MatrixXd ties = MatrixXd::Zero(s, s + p + 1);
    const VectorXd prior = StartPrior().cwiseInverse();
    VectorXd nominal(s);
    nominal << w.nominal.q, w.nominal.qd, w.nominal.integral;
    ties.leftCols(s) = prior.asDiagonal();
    ties.rightCols(1) = prior.cwiseProduct(nominal - w.start);
    TriangularFactor factor(s + p);
    factor.AddRows(rows.data(), rows.rows(), rows.rows());
    factor.AddRows(ties.data(), ties.rows(), ties.rows());
    all.windows.push_back({w.start, factor.Triangle()});
    all.cost +=
        rows.rightCols(1).squaredNorm() + ties.rightCols(1).squaredNorm();
    all.torque_rms += run.torque_squares;
    periods += run.period_of_row.back() + 1;
    const MatrixXd values_only =
        factor.Triangle().bottomRightCorner(p + 1, p + 1);
    triangle = triangle.size() == 0 ? values_only
                                    : MergeTriangles(triangle, values_only);
  }
  all.torque_rms = (all.torque_rms / static_cast<double>(periods)).cwiseSqrt();
  all.R = triangle.topLeftCorner(p, p);
  all.z = triangle.topRightCorner(p, 1);
  return all;
}

void LoopWindows::Move(const LoopEquations& equations, const VectorXd& dx,
                       double share) {
  const long s = 3 * n_, p = dx.size();
  for (size_t k = 0; k < windows_.size(); ++k) {
    const auto& [start, triangle] = equations.windows[k];
    const VectorXd rest =
        triangle.col(s + p).head(s) - triangle.block(0, s, s, p) * dx;
    windows_[k].start =
        start +
        share *
            triangle.topLeftCorner(s, s).triangularView<Eigen::Upper>().solve(
                rest);
  }
}

// Residuals of a whole log follow each other; its windows' do not, but for the
// moment that a loop takes to forget.
LoopScores LoopWindows::Scores(const LoopValues& values,
                               const LoopEquations& equations) const {
  const LoopColumns columns(n_);
  const int p = columns.num_values(), s = 3 * n_;
  LoopScores all;
  all.covariance = MatrixXd::Zero(p, p);
  std::mt19937 random(1);
  for (size_t l = 0; l < windows_.size(); ++l) {
    const Window& w = windows_[l];
    const MatrixXd& triangle = equations.windows[l].triangle;
    const LoopStart start = StartOf(w.start);
    const PositionLoop& loop = *loops_[w.log];
    const LoopRun run =
        loop.Run(values, start, w.first, w.rows, Wanted::kTangents);
    const LoopRun periods =
        loop.Run(values, start, w.first, w.rows, Wanted::kPeriods);
    const VectorXd scale = RowScale(w.rows);
    // Scores' weights, free of the start; and signs that squares are the
    // trace's estimate of.
    MatrixXd weights(n_ * w.rows, p + 1);
    const MatrixXd start_of_values =
        triangle.topLeftCorner(s, s).triangularView<Eigen::Upper>().solve(
            triangle.block(0, s, s, p));
    weights.leftCols(p) = run.by_values.leftCols(p) -
                          run.by_values.rightCols(s) * start_of_values;
    weights.leftCols(p) = scale.cwiseAbs2().asDiagonal() * weights.leftCols(p);
    for (long k = 0; k < weights.rows(); ++k) {
      weights(k, p) = (random() & 1) != 0 ? scale[k] : -scale[k];
    }
    const MatrixXd sum =
        LoopNoiseCovariance(controller_, values, periods, noise_, weights);
    all.covariance += sum.topLeftCorner(p, p);
    all.expected_squares += sum(p, p);
    AddScores(logs_[w.log].log.t.segment(w.first, w.rows), weights.leftCols(p),
              run.residual, &all.sums);
    all.residual_squares += scale.cwiseProduct(run.residual).squaredNorm();
  }
  return all;
}

VectorXd LoopWindows::ResidualRms(const LoopValues& values) const {
  VectorXd squares = VectorXd::Zero(n_);
  long count = 0;
  for (const Window& w : windows_) {
    const VectorXd& t = logs_[w.log].log.t;
    const LoopRun run = loops_[w.log]->Run(values, StartOf(w.start), w.first,
                                           w.rows, Wanted::kResidual);
    if (!run.finite) {
      return VectorXd::Constant(n_, std::numeric_limits<double>::infinity());
    }
    for (long k = 0; k < w.rows; ++k) {
      if (t[w.first + k] < t[w.first] + kCatchUp) continue;
      squares += run.residual.segment(n_ * k, n_).cwiseAbs2();
      ++count;
    }
  }
  return (squares / static_cast<double>(std::max(1L, count))).cwiseSqrt();
}

}  // namespace armcal
