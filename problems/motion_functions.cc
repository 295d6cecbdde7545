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
      regressor_(parameters),
      coulomb_(parameters.MakeRegressor().columns().terms) {
  for (int i = 0; i < parameters.num_joints(); ++i) {
    row_columns_.push_back(parameters.row_columns(i));
  }
}

void MotionRegressor::Enter(const Trajectory& trajectory) {
  trajectory_ = &trajectory;
  states_ = coulomb_.Follow(trajectory);
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

bool MotionRegressor::Useless(int sample) const {
  return coulomb_.size() > 0 && trajectory_->standstill[sample];
}

}  // namespace armcal
