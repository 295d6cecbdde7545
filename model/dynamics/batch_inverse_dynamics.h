#pragma once

#include <Eigen/Core>
#include <memory>

#include "model/dynamics/motion_columns.h"
#include "model/robot/link_paths.h"
#include "model/robot/robot.h"
#include "model/simd/kernels.h"

namespace armcal {

class RegressorPlan;

// InverseDynamics of many samples at once. May be used by many threads.
class BatchInverseDynamics {
 public:
  explicit BatchInverseDynamics(
      const Robot& robot, const simd::Kernels& kernels = simd::BestKernels());

  // tau[j][s]: torque of joint j at sample s, N m or N, of the rigid arm
  // without friction and armature.
  void Torque(const MotionColumns& motion, long count,
              double* const* tau) const;

 private:
  Eigen::VectorXd InertiaOf(const LinkPath& path) const;

  std::shared_ptr<const RegressorPlan> plan_;
  Eigen::VectorXd inertia_;  // of all links, stacked
  const simd::Kernels* kernels_;
};

}  // namespace armcal
