#include "model/dynamics/batch_inverse_dynamics.h"

#include <glog/logging.h>

#include "model/dynamics/regressor_plan.h"

namespace armcal {

BatchInverseDynamics::BatchInverseDynamics(const Robot& robot,
                                           const simd::Kernels& kernels)
    : plan_(
          std::make_shared<RegressorPlan>(robot, RegressorPlan::Places::kNone)),
      inertia_(10 * robot.num_joints()),
      kernels_(&kernels) {
  for (int i = 0; i < robot.num_joints(); ++i) {
    inertia_.segment<10>(10 * i) = robot.links[i].inertial.ToVector();
  }
}

void BatchInverseDynamics::Torque(const MotionColumns& motion, long count,
                                  double* const* tau) const {
  CHECK_EQ(motion.qdd.size(), plan_->num_joints());
  kernels_->inverse_dynamics(
      plan_->chain(), inertia_.data(),
      {motion.q.data(), motion.qd.data(), motion.qdd.data()}, count, tau);
}

}  // namespace armcal
