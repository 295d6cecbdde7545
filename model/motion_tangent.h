#pragma once

#include <Eigen/Core>

#include "model/aligned_numbers.h"
#include "model/arm_plan.h"
#include "model/batch_forward_dynamics.h"
#include "model/batch_inverse_dynamics.h"
#include "model/batch_regressor.h"
#include "model/geometry_jacobian.h"
#include "model/stage_stepper.h"

namespace armcal {

// Rows of equal length in whole cache lines: derivatives by parameters, which
// kernels take several of at once.
class TangentRows {
 public:
  TangentRows() = default;
  TangentRows(int rows, int columns)
      : stride_((columns + 7) / 8 * 8), numbers_(rows * stride_) {}

  long stride() const { return stride_; }
  double* row(int r) { return numbers_.data() + r * stride_; }
  const double* row(int r) const { return numbers_.data() + r * stride_; }
  double& operator()(int r, int c) { return row(r)[c]; }
  double operator()(int r, int c) const { return row(r)[c]; }

 private:
  long stride_ = 0;
  AlignedNumbers numbers_;
};

// How the motion of an arm changes with its own parameters, its start and the
// torque that it is given: the exact derivatives of StageStepper's steps.
// Parameters, in the order of columns: ten inertial ones per link; viscous,
// coulomb, offset, armature of each joint; the width of each joint's Coulomb
// transition.
class MotionTangent {
 public:
  explicit MotionTangent(const RolloutArm& arm,
                         const simd::Kernels& kernels = simd::BestKernels());

  int num_joints() const { return static_cast<int>(arm_.robot.links.size()); }
  int num_parameters() const { return 15 * num_joints(); }

  // Takes the first `steps` of a motion, samples in lanes.
  void Linearise(const StageMotion& motion, long steps);

  // Takes `state` (2 n rows: by q, then qd) through one of these steps, under a
  // torque whose derivatives (n rows each) are those at its begin, middle and
  // end. `by_parameters`: the first num_parameters() columns are these
  // parameters'.
  void Advance(long step, double length, const TangentRows* const torque[3],
               bool by_parameters, TangentRows* state) const;

 private:
  void SetInertia(const StageMotion& motion, long count);
  void SetByState(const StageMotion& motion, long count);
  void SetDirect(const StageMotion& motion, long count);
  double* Record(long sample) { return records_.data() + sample * size_; }
  const double* Record(long sample) const {
    return records_.data() + sample * size_;
  }

  RolloutArm arm_;
  const simd::Kernels* kernels_;
  BatchForwardDynamics inertia_;
  BatchInverseDynamics torque_;
  BatchRegressor regressor_;
  GeometryJacobian by_position_;
  long direct_, direct_columns_, size_;  // of a record
  // Of each stage: inertia, by q, by qd, n x n each; at direct_ n rows by
  // parameters.
  AlignedNumbers records_;
  AlignedNumbers columns_;  // scratch, as kernels write it
  long capacity_ = 0;
};

}  // namespace armcal
