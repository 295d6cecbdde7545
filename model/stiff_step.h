#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <functional>

namespace armcal {

// Steps of x' = f(t, x) that stay stable however stiff f is: the diagonally
// implicit Runge-Kutta method of Alexander (1977) with two stages, order 2,
// L-stable and stiffly accurate. For few states; Jacobians are differences.
// Keeps scratch, so use one per thread.
class StiffStep {
 public:
  using Rate = std::function<void(double t, const double* x, double* rate)>;

  explicit StiffStep(int num_states);

  // From x at t to x at t + h.
  void Advance(const Rate& rate, double t, double h, Eigen::VectorXd* x);

 private:
  // No law has more states; scratch without allocations.
  static constexpr int kMostStates = 8;
  using State = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostStates, 1>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0,
                               kMostStates, kMostStates>;

  // Solves stage = base + gamma h f(t, stage) from the stage's start value.
  void Solve(const Rate& rate, double t, double h);
  void FactorAt(const Rate& rate, double t, double h, double scale);

  State base_, stage_, rate_, shifted_, residual_;
  // Of 1 - gamma h df/dx, kept while it brings the stage nearer quickly.
  Eigen::PartialPivLU<Matrix> factor_;
  double factored_step_ = 0;  // h; 0 where there is none
};

}  // namespace armcal
