#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <vector>

namespace armcal {

// All torque equations of the logs at once, from their triangular factor:
//   r = R [V_1 .. V_n, y_1, y_2, ..] - z,
// whitened and compressed. V_i are the links' inertial parameters in
// log-Cholesky coordinates, y_k blocks in which the equations are linear: joint
// terms, and the geometry about some values. Parameter blocks: n of 10, then
// those of y that are not empty.
class TorqueFactorResidual : public ceres::CostFunction {
 public:
  // R: rows x (10 n + sum of sizes).
  TorqueFactorResidual(const Eigen::MatrixXd& R, const Eigen::VectorXd& z,
                       int num_links, const std::vector<int>& sizes);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  Eigen::MatrixXd R_;
  Eigen::VectorXd z_;
  int num_links_;
  std::vector<int> sizes_;
};

}  // namespace armcal
