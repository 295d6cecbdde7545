#pragma once

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

#include "model/dynamics/momentum_regressor.h"
#include "model/dynamics/regressor.h"

namespace armcal {

// How a weighted sum of a regressor's entries changes with the motion: what a
// criterion of many samples needs to be improved by moving differently.
class RegressorGradient {
 public:
  RegressorGradient(const ProximalChain& chain,
                    const std::vector<Length>& unknown,
                    const RegressorColumns& columns);

  // Adds the gradients in q, qd and qdd (n entries each) of
  // sum_ic G(i, c) U(i, c), with U of Regressor::Differential and G n x
  // columns. Coulomb columns follow the velocity law of their width.
  void Add(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
           const Eigen::VectorXd& qdd, const Eigen::MatrixXd& G,
           Eigen::VectorXd* of_q, Eigen::VectorXd* of_qd,
           Eigen::VectorXd* of_qdd);

 private:
  // d/dt of d/d(directions): a number and its gradient, both with their rates
  // along (qd, qdd). Directions are taken kWidth at a time.
  static constexpr int kWidth = 8;
  using Gradient = Eigen::AutoDiffScalar<Eigen::Matrix<double, kWidth, 1>>;
  using Rate = Eigen::AutoDiffScalar<Eigen::Matrix<Gradient, 1, 1>>;

  void AddDirections(const Eigen::VectorXd& state, const Eigen::VectorXd& qdd,
                     const Eigen::MatrixXd& G, int begin,
                     Eigen::VectorXd* of_sum, Eigen::VectorXd* of_p);

  int num_joints_;
  RegressorColumns columns_;
  MomentumRegressor<Rate> momentum_;
  MomentumRegressor<Rate>::Matrix P_, D_;
  MomentumRegressor<Rate>::Vector q_, qd_;
};

}  // namespace armcal
