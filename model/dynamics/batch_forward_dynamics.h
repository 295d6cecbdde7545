#pragma once

#include <Eigen/Core>
#include <memory>

#include "model/robot/robot.h"
#include "model/simd/kernels.h"

namespace armcal {

class ArmPlan;

// MassMatrix and ForwardDynamics of many samples at once; matrices have samples
// in rows. May be used by many threads.
class BatchForwardDynamics {
 public:
  explicit BatchForwardDynamics(
      const Robot& robot, const simd::Kernels& kernels = simd::BestKernels());

  // M(q) of the links, row by row: element (i, j) in column n i + j.
  void MassMatrix(const Eigen::MatrixXd& q, Eigen::MatrixXd* M) const;

  // qdd that the torque gives the links and their joints' armature. NaN where
  // no inertia resists a joint, or something given is no number.
  void Acceleration(const Eigen::MatrixXd& q, const Eigen::MatrixXd& qd,
                    const Eigen::MatrixXd& tau, Eigen::MatrixXd* qdd) const;

 private:
  std::shared_ptr<const ArmPlan> plan_;
  const simd::ArmKernels* kernels_;
};

}  // namespace armcal
