#include "model/dynamics/arm_stepper.h"

#include <glog/logging.h>

namespace armcal {

using Eigen::VectorXd;

ArmStepper::ArmStepper(const RolloutArm& arm, const simd::Kernels& kernels)
    : plan_(std::make_shared<ArmPlan>(arm, kernels.one_arm.lanes)),
      kernels_(&kernels.one_arm) {
  const VectorXd zero = VectorXd::Zero(plan_->num_joints());
  q_ = qd_ = coulomb_ = zero;
}

void ArmStepper::SetState(const VectorXd& q, const VectorXd& qd,
                          const VectorXd& coulomb) {
  const Eigen::Index n = num_joints();
  CHECK(q.size() == n && qd.size() == n);
  CHECK(coulomb.size() == n || coulomb.size() == 0);
  q_ = q;
  qd_ = qd;
  if (coulomb.size() == 0) {
    coulomb_.setZero();
  } else {
    coulomb_ = coulomb;
  }
}

bool ArmStepper::Advance(double step, const VectorXd& tau_begin,
                         const VectorXd& tau_end) {
  CHECK(tau_begin.size() == q_.size() && tau_end.size() == q_.size());
  return kernels_->advance(plan_->constants(), step, tau_begin.data(),
                           tau_end.data(),
                           {q_.data(), qd_.data(), coulomb_.data(), 1}) == 0;
}

}  // namespace armcal
