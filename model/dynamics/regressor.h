#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "model/dynamics/regressor_columns.h"

namespace armcal {

class RegressorPlan;

// Evaluates regressors state by state, in closed form (model/simd); for many
// states BatchRegressor is faster. MomentumRegressor, differentiated
// automatically, is the oracle of both. Keeps scratch, so use one per thread.
class Regressor {
 public:
  Regressor(const ProximalChain& chain, const std::vector<Length>& unknown,
            const RegressorColumns& columns);

  // P and D (n x columns) with tau = (d/dt P - D) X; q, qd: n entries;
  // coulomb: the states of the Coulomb columns in their order.
  void Momentum(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                const Eigen::VectorXd& coulomb, Eigen::MatrixXd* P,
                Eigen::MatrixXd* D);
  // U (n x columns) with tau = U X, (2.20).
  void Differential(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                    const Eigen::VectorXd& qdd, const Eigen::VectorXd& coulomb,
                    Eigen::MatrixXd* U);

  const RegressorColumns& columns() const { return columns_; }

 private:
  int num_joints_;
  RegressorColumns columns_;
  std::shared_ptr<const RegressorPlan> plan_;
  std::vector<const double*> q_, qd_, qdd_;  // of each joint
  std::vector<double*> rows_, more_rows_;
};

}  // namespace armcal
