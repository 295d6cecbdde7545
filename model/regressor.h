#pragma once

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>
#include <vector>

#include "model/joint_term.h"
#include "model/momentum_regressor.h"

namespace armcal {

// Which functions the columns of a regressor are: column moment_index[k] is
// moments[k], column term_index[k] is terms[k].
struct RegressorColumns {
  std::vector<MomentColumn> moments;
  std::vector<int> moment_index;
  std::vector<JointTermColumn> terms;
  std::vector<int> term_index;

  int size() const { return static_cast<int>(moments.size() + terms.size()); }
};

// Evaluates regressors state by state; keeps scratch, so use one per thread.
class Regressor {
 public:
  Regressor(const ProximalChain& chain, const std::vector<Length>& unknown,
            const RegressorColumns& columns);

  // P and D (n x columns) with tau = (d/dt P - D) X; q, qd: n entries;
  // coulomb: the states of the Coulomb columns in their order.
  void Momentum(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                const Eigen::VectorXd& coulomb, Eigen::MatrixXd* P,
                Eigen::MatrixXd* D);
  // U (n x columns) with tau = U X, (2.20); d/dt P by automatic
  // differentiation along (qd, qdd).
  void Differential(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                    const Eigen::VectorXd& qdd, const Eigen::VectorXd& coulomb,
                    Eigen::MatrixXd* U);

  const RegressorColumns& columns() const { return columns_; }

 private:
  using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;

  int num_joints_;
  RegressorColumns columns_;
  MomentumRegressor<double> momentum_;
  MomentumRegressor<Dual> momentum_rate_;
  MomentumRegressor<double>::Matrix P_, D_;
  MomentumRegressor<Dual>::Matrix P_dual_, D_dual_;
  MomentumRegressor<Dual>::Vector q_dual_, qd_dual_;
};

}  // namespace armcal
