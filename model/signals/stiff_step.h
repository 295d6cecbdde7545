#pragma once

#include <glog/logging.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace armcal {

// Steps of x' = f(t, x) that stay stable however stiff f is: the diagonally
// implicit Runge-Kutta method of Alexander (1977) with two stages, order 2,
// L-stable and stiffly accurate. For few states; Jacobians are differences.
// Keeps scratch, so use one per thread. Rates are called as
// rate(t, const double* x, double* dx), at the same t several times in a row.
// `Size`: of the state, or Eigen::Dynamic.
template <int Size>
class StiffStepOf {
 public:
  explicit StiffStepOf(int num_states)
      : base_(num_states),
        stage_(num_states),
        rate_(num_states),
        shifted_(num_states),
        residual_(num_states) {
    CHECK_LE(num_states, kMostStates);
  }

  // From x at t to x at t + h.
  template <typename AnyRate>
  void Advance(const AnyRate& rate, double t, double h, Eigen::VectorXd* x) {
    CHECK_EQ(x->size(), size());
    Eigen::Map<State> at(x->data(), size());
    base_ = at;
    stage_ = at;
    Solve(rate, t + kGamma * h, h);
    // gamma h f of the first stage, which the second weighs by (1 - gamma).
    base_ = at + (1 - kGamma) / kGamma * (stage_ - at);
    Solve(rate, t + h, h);
    at = stage_;
  }

 private:
  static constexpr double kGamma = 1 - M_SQRT1_2;
  static constexpr int kMostIterations = 12;
  static constexpr double kTolerance = 1e-10;
  // An iteration that leaves more of the residual has an old Jacobian.
  static constexpr double kSlow = .2;
  // No law has more states; scratch without allocations.
  static constexpr int kMostStates = Size == Eigen::Dynamic ? 8 : Size;
  using State = Eigen::Matrix<double, Size, 1, 0, kMostStates, 1>;

  int size() const { return static_cast<int>(stage_.size()); }

  // Solves stage = base + gamma h f(t, stage) from the stage's start value.
  template <typename AnyRate>
  void Solve(const AnyRate& rate, double t, double h) {
    double before = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < kMostIterations; ++iteration) {
      rate(t, stage_.data(), rate_.data());
      residual_ = base_ + kGamma * h * rate_ - stage_;
      const double left = residual_.template lpNorm<Eigen::Infinity>();
      const double scale =
          std::max({stage_.template lpNorm<Eigen::Infinity>(),
                    h * rate_.template lpNorm<Eigen::Infinity>(), 1e-12});
      if (left <= kTolerance * scale) return;
      if (h != factored_step_ || !(left < kSlow * before)) {
        FactorAt(rate, t, h, scale);
      }
      before = left;
      SolveFactored();
      stage_ += residual_;
    }
  }

  template <typename AnyRate>
  void FactorAt(const AnyRate& rate, double t, double h, double scale) {
    const double dx = 1e-6 * scale;
    for (int k = 0; k < size(); ++k) {
      const double at = stage_[k];
      stage_[k] = at + dx;
      rate(t, stage_.data(), shifted_.data());
      stage_[k] = at;
      for (int i = 0; i < size(); ++i) {
        factor_[i][k] = (i == k) - kGamma * h / dx * (shifted_[i] - rate_[i]);
      }
    }
    Factor();
    factored_step_ = h;
  }

  // Gaussian elimination with partial pivots: of so few states in a fraction
  // of the time that a general one takes.
  void Factor() {
    for (int k = 0; k < size(); ++k) {
      int best = k;
      for (int i = k + 1; i < size(); ++i) {
        if (std::abs(factor_[i][k]) > std::abs(factor_[best][k])) best = i;
      }
      pivot_[k] = best;
      if (best != k) std::swap(factor_[k], factor_[best]);
      for (int i = k + 1; i < size(); ++i) {
        factor_[i][k] /= factor_[k][k];
        for (int j = k + 1; j < size(); ++j) {
          factor_[i][j] -= factor_[i][k] * factor_[k][j];
        }
      }
    }
  }

  void SolveFactored() {  // residual_, in place
    for (int k = 0; k < size(); ++k) {
      std::swap(residual_[k], residual_[pivot_[k]]);
    }
    for (int k = 0; k < size(); ++k) {
      for (int i = k + 1; i < size(); ++i) {
        residual_[i] -= factor_[i][k] * residual_[k];
      }
    }
    for (int k = size() - 1; k >= 0; --k) {
      for (int j = k + 1; j < size(); ++j) {
        residual_[k] -= factor_[k][j] * residual_[j];
      }
      residual_[k] /= factor_[k][k];
    }
  }

  State base_, stage_, rate_, shifted_, residual_;
  // Of 1 - gamma h df/dx, kept while it brings the stage nearer quickly.
  double factor_[kMostStates][kMostStates];
  int pivot_[kMostStates];
  double factored_step_ = 0;  // h; 0 where there is none
};

using StiffStep = StiffStepOf<Eigen::Dynamic>;

}  // namespace armcal
