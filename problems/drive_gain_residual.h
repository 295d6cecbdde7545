#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <vector>

namespace armcal {

// One joint's equations between motion and motor current, whitened and
// compressed, of the bare arm or of the arm with a payload:
//   z = g A (x + B p)   (p = 0 for the bare arm).
struct CurrentEquations {
  int joint;
  bool loaded;
  Eigen::MatrixXd A;  // rows x m
  Eigen::VectorXd z;  // rows
};

// Their residuals g A (x + B p) - z, over all joints. The error is in the
// currents, so they are the left side; currents as regressors would bias the
// gains (errors in variables). Parameter blocks:
//   g  n   current per torque, in units of a common scale s: 1 / K_j = s g_j;
//   x  m   model parameters of the bare arm, times s;
//   p  10  inertial parameters of the payload (its mass first), times s.
// (g, x, p) and (c g, x / c, p / c) give the same residuals.
class DriveGainResidual : public ceres::CostFunction {
 public:
  // B: m x 10, what a body on the last link adds to the model parameters.
  DriveGainResidual(const std::vector<CurrentEquations>& equations,
                    int num_joints, const Eigen::MatrixXd& B);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  std::vector<CurrentEquations> equations_;
  int num_joints_;
  Eigen::MatrixXd B_;
};

}  // namespace armcal
