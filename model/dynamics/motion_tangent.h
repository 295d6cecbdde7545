#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "model/dynamics/arm_plan.h"
#include "model/dynamics/batch_forward_dynamics.h"
#include "model/dynamics/batch_inverse_dynamics.h"
#include "model/dynamics/batch_regressor.h"
#include "model/dynamics/geometry_jacobian.h"
#include "model/dynamics/joint_term.h"
#include "model/text/aligned_numbers.h"

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

// What of an arm derivatives are taken by, in this order.
struct TangentParameters {
  std::vector<int> inertials;  // of the links' ten each, ascending
  struct Term {
    int joint;
    std::optional<JointTerm> term;  // nothing: the Coulomb transition's width
  };
  std::vector<Term> terms;

  int size() const { return static_cast<int>(inertials.size() + terms.size()); }
};

// How the motion of an arm with viscous and Coulomb friction by velocity laws,
// offset and armature changes with its own parameters, with where it starts and
// with a torque that is constant over periods of equal length. By the implicit
// midpoint rule, but for torques by joints' velocities together, which are of
// first order in the length: 0.1 % with a millisecond. That is enough for
// estimates, whose minimum is where it is by the residuals and not by the last
// digits of derivatives.
class MotionTangent {
 public:
  MotionTangent(const RolloutArm& arm, const TangentParameters& parameters,
                const simd::Kernels& kernels = simd::BestKernels());

  int num_joints() const { return static_cast<int>(arm_.robot.links.size()); }
  int num_parameters() const { return parameters_.size(); }

  // Takes periods of `length` s from row `first` on, at whose borders the arm
  // was at (q, qd), a row each.
  void Linearise(const Eigen::MatrixXd& q, const Eigen::MatrixXd& qd,
                 long first, long periods, double length);

  // Takes `state` (2 n rows: by q, then qd) through one of these, under a
  // torque with these derivatives (n rows). `by_parameters`: the first
  // num_parameters() columns are these parameters'.
  void Advance(long period, const TangentRows& torque, bool by_parameters,
               TangentRows* state) const;

 private:
  struct Means;
  void SetInertia(const Means& means);
  void SetByState(const Means& means);
  void SetInertials(const Means& means);
  void SetTerms(const Means& means);
  double* Record(long period) { return records_.data() + period * size_; }
  const double* Record(long period) const {
    return records_.data() + period * size_;
  }

  RolloutArm arm_;
  TangentParameters parameters_;
  const simd::Kernels* kernels_;
  BatchForwardDynamics inertia_;
  BatchInverseDynamics torque_;
  std::optional<BatchRegressor> regressor_;
  GeometryJacobian by_position_;
  long direct_, direct_columns_, size_;  // of a record
  double length_ = 0;
  // Of each period: inertia, by q, by qd, n x n each; at direct_ n rows by
  // parameters.
  AlignedNumbers records_;
  AlignedNumbers columns_;  // scratch, as kernels write it
  long capacity_ = 0;
};

}  // namespace armcal
