#pragma once

#include <Eigen/Core>
#include <memory>

#include "model/dynamics/arm_plan.h"
#include "model/simd/kernels.h"

namespace armcal {

// One arm, step by step: BatchRollout's steps where only one window is wanted.
// Keeps the state, so use one per thread.
class ArmStepper {
 public:
  explicit ArmStepper(const RolloutArm& arm,
                      const simd::Kernels& kernels = simd::BestKernels());

  int num_joints() const { return static_cast<int>(q_.size()); }
  const Eigen::VectorXd& q() const { return q_; }
  const Eigen::VectorXd& qd() const { return qd_; }
  // States of displacement laws, -1 to 1.
  const Eigen::VectorXd& coulomb() const { return coulomb_; }

  // n entries each; `coulomb` of none starts at 0.
  void SetState(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                const Eigen::VectorXd& coulomb = {});

  // Advances by `step` s under a torque that is linear in between, N m or N.
  // False where the state is of no use any more: it is 0 then.
  bool Advance(double step, const Eigen::VectorXd& tau_begin,
               const Eigen::VectorXd& tau_end);

 private:
  std::shared_ptr<const ArmPlan> plan_;
  const simd::ArmKernels* kernels_;
  Eigen::VectorXd q_, qd_, coulomb_;
};

}  // namespace armcal
