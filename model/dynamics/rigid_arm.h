#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "model/dynamics/arm_dynamics.h"
#include "model/robot/robot.h"
#include "model/simd/kernels.h"

namespace armcal {

class ArmPlan;

// Our own dynamics as an engine for simulations: forward_dynamics.h's, prepared
// once and by the kernels of model/simd. It takes links that no body could
// have, too.
class RigidArm : public ArmDynamics {
 public:
  explicit RigidArm(Robot robot,
                    const simd::Kernels& kernels = simd::BestKernels());

  int num_joints() const override { return robot_.num_joints(); }
  void Evaluate(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                const std::vector<Attachment>& attachments,
                ArmTerms* terms) override;

 private:
  Robot robot_;
  std::shared_ptr<const ArmPlan> plan_;
  const simd::ArmKernels* kernels_;
};

}  // namespace armcal
