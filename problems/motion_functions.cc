#include "problems/motion_functions.h"

namespace armcal {

std::vector<int> RowSizes(const MotionFunctions& functions, int more) {
  std::vector<int> sizes;
  for (const std::vector<int>& columns : functions.row_columns()) {
    sizes.push_back(static_cast<int>(columns.size()) + more);
  }
  return sizes;
}

MotionRegressor::MotionRegressor(const ModelParameters& parameters)
    : parameters_(parameters),
      columns_(parameters.MakeRegressor().columns()),
      regressor_(parameters),
      coulomb_(columns_.terms) {
  for (int i = 0; i < parameters.num_joints(); ++i) {
    row_columns_.push_back(parameters.row_columns(i));
  }
}

void MotionRegressor::Enter(const Trajectory& trajectory) {
  trajectory_ = &trajectory;
  states_ = coulomb_.FollowTorque(trajectory);
}

MotionColumns MotionRegressor::Columns(int first) const {
  return MotionColumns(trajectory_->q, trajectory_->qd, trajectory_->qdd,
                       states_, first);
}

void MotionRegressor::Momentum(int first, int count, double* const* P,
                               double* const* D, long stride) const {
  regressor_.Momentum(Columns(first), count, P, D, stride);
}

void MotionRegressor::Differential(int first, int count, double* const* U,
                                   long stride) const {
  regressor_.Differential(Columns(first), count, U, stride);
}

Eigen::MatrixXd MotionRegressor::CoulombTorque(const Eigen::VectorXd& x) const {
  Eigen::MatrixXd torque =
      Eigen::MatrixXd::Zero(states_.rows(), parameters_.num_joints());
  Eigen::Index state = 0;
  for (size_t k = 0; k < columns_.terms.size(); ++k) {
    const JointTermColumn& column = columns_.terms[k];
    if (column.term != JointTerm::kCoulomb) continue;
    torque.col(column.joint) +=
        x[columns_.term_index[k]] * states_.col(state++);
  }
  return torque;
}

bool MotionRegressor::Useless(int sample) const {
  return coulomb_.size() > 0 && trajectory_->standstill[sample];
}

}  // namespace armcal
