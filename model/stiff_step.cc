#include "model/stiff_step.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

constexpr double kGamma = 1 - M_SQRT1_2;
constexpr int kMostIterations = 8;

}  // namespace

StiffStep::StiffStep(int num_states)
    : base_(num_states),
      stage_(num_states),
      rate_(num_states),
      shifted_(num_states),
      residual_(num_states),
      matrix_(num_states, num_states) {}

void StiffStep::Solve(const Rate& rate, double t, double h) {
  const int size = static_cast<int>(stage_.size());
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    rate(t, stage_.data(), rate_.data());
    residual_ = base_ + kGamma * h * rate_ - stage_;
    const double scale = std::max({stage_.lpNorm<Eigen::Infinity>(),
                                   h * rate_.lpNorm<Eigen::Infinity>(), 1e-12});
    if (residual_.lpNorm<Eigen::Infinity>() <= 1e-10 * scale) return;
    for (int k = 0; k < size; ++k) {
      const double dx = 1e-6 * scale;
      const double at = stage_[k];
      stage_[k] = at + dx;
      rate(t, stage_.data(), shifted_.data());
      stage_[k] = at;
      matrix_.col(k) = -kGamma * h / dx * (shifted_ - rate_);
      matrix_(k, k) += 1;
    }
    if (size == 1) {
      stage_[0] += residual_[0] / matrix_(0, 0);
    } else {
      stage_ += matrix_.partialPivLu().solve(residual_);
    }
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
