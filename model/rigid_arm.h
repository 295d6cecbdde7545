#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/arm_dynamics.h"
#include "model/robot.h"

namespace armcal {

// Our own dynamics as an engine for simulations (forward_dynamics.h). It takes
// links that no body could have, too.
class RigidArm : public ArmDynamics {
 public:
  explicit RigidArm(Robot robot) : robot_(std::move(robot)) {}

  int num_joints() const override { return robot_.num_joints(); }
  void Evaluate(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                const std::vector<Attachment>& attachments,
                ArmTerms* terms) override;

 private:
  Robot robot_;
};

}  // namespace armcal
