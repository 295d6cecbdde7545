#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>

namespace armcal {

// All torque equations of the logs at once, from their triangular factor:
//   r = R [V_1 .. V_n, joint terms, g - g_0] - z,
// whitened and compressed, exact for everything but the geometry g, in which it
// is linear about g_0. V_i are the links' inertial parameters in log-Cholesky
// coordinates. Parameter blocks: n of 10, one of all joint terms, one of g.
class TorqueFactorResidual : public ceres::CostFunction {
 public:
  // R: rows x (10 n + num_terms + g_0.size()).
  TorqueFactorResidual(const Eigen::MatrixXd& R, const Eigen::VectorXd& z,
                       int num_links, int num_terms,
                       const Eigen::VectorXd& g_0);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  Eigen::MatrixXd R_;
  Eigen::VectorXd z_, g_0_;
  int num_links_, num_terms_;
};

}  // namespace armcal
