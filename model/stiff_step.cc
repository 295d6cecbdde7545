#include "model/stiff_step.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace armcal {
namespace {

constexpr double kGamma = 1 - M_SQRT1_2;
constexpr int kMostIterations = 12;
constexpr double kTolerance = 1e-10;
// An iteration that leaves more of the residual has an old Jacobian.
constexpr double kSlow = .2;

}  // namespace

StiffStep::StiffStep(int num_states)
    : base_(num_states),
      stage_(num_states),
      rate_(num_states),
      shifted_(num_states),
      residual_(num_states) {
  CHECK_LE(num_states, kMostStates);
}

void StiffStep::FactorAt(const Rate& rate, double t, double h, double scale) {
  const int size = static_cast<int>(stage_.size());
  Matrix matrix = Matrix::Identity(size, size);
  const double dx = 1e-6 * scale;
  for (int k = 0; k < size; ++k) {
    const double at = stage_[k];
    stage_[k] = at + dx;
    rate(t, stage_.data(), shifted_.data());
    stage_[k] = at;
    matrix.col(k) -= kGamma * h / dx * (shifted_ - rate_);
  }
  factor_.compute(matrix);
  factored_step_ = h;
}

void StiffStep::Solve(const Rate& rate, double t, double h) {
  double before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    rate(t, stage_.data(), rate_.data());
    residual_ = base_ + kGamma * h * rate_ - stage_;
    const double left = residual_.lpNorm<Eigen::Infinity>();
    const double scale = std::max({stage_.lpNorm<Eigen::Infinity>(),
                                   h * rate_.lpNorm<Eigen::Infinity>(), 1e-12});
    if (left <= kTolerance * scale) return;
    if (h != factored_step_ || !(left < kSlow * before)) {
      FactorAt(rate, t, h, scale);
    }
    before = left;
    stage_ += factor_.solve(residual_);
  }
}

void StiffStep::Advance(const Rate& rate, double t, double h,
                        Eigen::VectorXd* x) {
  base_ = *x;
  stage_ = *x;
  Solve(rate, t + kGamma * h, h);
  // gamma h f of the first stage, which the second weighs by (1 - gamma).
  base_ = *x + (1 - kGamma) / kGamma * (stage_ - *x);
  Solve(rate, t + h, h);
  *x = stage_;
}

}  // namespace armcal
