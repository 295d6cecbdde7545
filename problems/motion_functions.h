#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/dynamics/batch_regressor.h"
#include "model/dynamics/joint_term.h"
#include "model/dynamics/model_parameters.h"
#include "model/signals/trajectory.h"

namespace armcal {

// Columns P and D of the joints' equations tau = (d/dt P - D) x along a log.
// Use a new one for each pass over a log, and Enter() each trajectory in turn:
// the states of Coulomb friction are followed from one to the next. Between,
// any number of threads may evaluate it.
class MotionFunctions {
 public:
  virtual ~MotionFunctions() = default;
  virtual int size() const = 0;  // columns
  // Those that can be nonzero in each joint's equation, ascending.
  virtual const std::vector<std::vector<int>>& row_columns() const = 0;
  virtual void Enter(const Trajectory& trajectory) = 0;
  // P and D of `count` samples of the trajectory entered last: of joint i,
  // column row_columns()[i][c] of sample first + s is P[i][c * stride + s].
  virtual void Momentum(int first, int count, double* const* P,
                        double* const* D, long stride) const = 0;
  // U of tau = U x at the same samples, laid out like P.
  virtual void Differential(int first, int count, double* const* U,
                            long stride) const = 0;
  // With Coulomb friction in the model, a sample at which the whole arm stands
  // still says nothing: its friction can have any value.
  virtual bool Useless(int sample) const = 0;
};

// The number of columns of each joint's equation and `more`.
std::vector<int> RowSizes(const MotionFunctions& functions, int more);

// Those of the model parameters.
class MotionRegressor : public MotionFunctions {
 public:
  explicit MotionRegressor(const ModelParameters& parameters);

  const ModelParameters& parameters() const { return parameters_; }
  int size() const override { return parameters_.size(); }
  const std::vector<std::vector<int>>& row_columns() const override {
    return row_columns_;
  }
  void Enter(const Trajectory& trajectory) override;
  void Momentum(int first, int count, double* const* P, double* const* D,
                long stride) const override;
  void Differential(int first, int count, double* const* U,
                    long stride) const override;
  bool Useless(int sample) const override;
  // Torque of Coulomb friction alone, N m or N, of parameters x, along the
  // trajectory: samples x joints.
  Eigen::MatrixXd CoulombTorque(const Eigen::VectorXd& x) const;

 private:
  MotionColumns Columns(int first) const;

  ModelParameters parameters_;
  RegressorColumns columns_;
  std::vector<std::vector<int>> row_columns_;
  BatchRegressor regressor_;
  CoulombStates coulomb_;
  const Trajectory* trajectory_ = nullptr;
  Eigen::MatrixXd states_;
};

}  // namespace armcal
