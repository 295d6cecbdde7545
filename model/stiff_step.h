#pragma once

#include <Eigen/Core>
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
  // Solves stage = base + gamma h f(t, stage) from the stage's start value.
  void Solve(const Rate& rate, double t, double h);

  Eigen::VectorXd base_, stage_, rate_, shifted_, residual_;
  Eigen::MatrixXd matrix_;  // 1 - gamma h df/dx
};

}  // namespace armcal
