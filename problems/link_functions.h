#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/dynamics/batch_regressor.h"
#include "model/dynamics/geometry_jacobian.h"
#include "model/dynamics/joint_term.h"
#include "model/robot/arm_geometry.h"
#include "problems/motion_functions.h"

namespace armcal {

// Columns of what a robot file holds: the links' inertial parameters (10 each),
// joint terms, and the geometry's parameters, in which the torque is taken
// linearly about `geometry` and the robot's inertia.
class LinkFunctions : public MotionFunctions {
 public:
  // The arm is `robot` with `geometry` in place of its own. `refined`: which of
  // the geometry's parameters have a column.
  LinkFunctions(const Robot& robot, const std::vector<JointTermColumn>& terms,
                const ArmGeometry& geometry, const std::vector<int>& refined);
  // Of the inertial parameters only `inertial` (BaseInertials).
  LinkFunctions(const Robot& robot, const std::vector<JointTermColumn>& terms,
                const ArmGeometry& geometry, const std::vector<int>& refined,
                const std::vector<int>& inertial);

  int size() const override { return columns_; }
  const std::vector<std::vector<int>>& row_columns() const override {
    return row_columns_;
  }
  void Enter(const Trajectory& trajectory) override;
  void Momentum(int first, int count, double* const* P, double* const* D,
                long stride) const override;
  void Differential(int first, int count, double* const* U,
                    long stride) const override;
  bool Useless(int sample) const override;

 private:
  MotionColumns Motion(int first) const;
  // Calls write(term, joint, place of its column, Coulomb state or null).
  template <class Write>
  void ForEachTerm(int first, long stride, const Write& write) const;
  // Where the geometry's columns are of each row.
  std::vector<double*> Geometry(double* const* rows, long stride) const;

  std::vector<JointTermColumn> terms_;
  BatchRegressor regressor_;
  GeometryJacobian geometry_;
  CoulombStates coulomb_;
  const Trajectory* trajectory_ = nullptr;
  Eigen::MatrixXd states_;
  int columns_;
  std::vector<std::vector<int>> row_columns_;
};

// The links' inertial parameters, stacked.
Eigen::VectorXd StackInertials(const Robot& robot);

}  // namespace armcal
