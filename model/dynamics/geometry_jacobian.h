#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "model/dynamics/motion_columns.h"
#include "model/robot/arm_geometry.h"
#include "model/robot/robot.h"
#include "model/simd/kernels.h"

namespace armcal {

class RegressorPlan;

// Derivatives of the torques of a rigid arm by parameters of its geometry, of
// many samples at once, exact. Column c of joint i and sample s is
// out[i][c * stride + s], as in BatchRegressor; a sample's results are the same
// bits whichever others it is evaluated with. May be used by many threads.
class GeometryJacobian {
 public:
  // Of `robot` with `geometry` in place of its own; `parameters`: those of the
  // geometry that have a column.
  GeometryJacobian(const Robot& robot, const ArmGeometry& geometry,
                   const std::vector<int>& parameters,
                   const simd::Kernels& kernels = simd::BestKernels());
  // Of twists that displace parts of `robot` as it is, a column each.
  GeometryJacobian(const Robot& robot, const std::vector<CarriedTwist>& twists,
                   const simd::Kernels& kernels = simd::BestKernels());

  int num_joints() const;
  // Columns of every joint's equation.
  int size() const { return size_; }

  // Of the torque, N m or N per m or rad.
  void Torque(const MotionColumns& motion, long count, double* const* out,
              long stride) const;
  // Of dL/dqd (P) and dL/dq (D), with torque = d/dt P - D; no accelerations are
  // read.
  void Momentum(const MotionColumns& motion, long count, double* const* P,
                double* const* D, long stride) const;
  // Of one sample, n x size(), not in lanes.
  Eigen::MatrixXd Torque(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                         const Eigen::VectorXd& qdd) const;
  void Momentum(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                Eigen::MatrixXd* P, Eigen::MatrixXd* D) const;

 private:
  // Of a path of the plan: parameters that displace something on it, and its
  // own links' bodies.
  struct PathGeometry {
    std::vector<simd::GeometricParameter> parameters;
    std::vector<simd::BodyMoments> bodies;
  };
  template <class Evaluate>
  void SumPaths(const simd::ChainMotion& motion, long count, double* const* out,
                double* const* more, long stride,
                const Evaluate& evaluate) const;

  std::shared_ptr<const RegressorPlan> plan_;
  std::vector<PathGeometry> paths_;
  int size_;
  std::vector<int> row_sizes_;
  const simd::Kernels* kernels_;
};

// The joints' motions as such twists: their columns are derivatives by q.
std::vector<CarriedTwist> JointTwists(const Robot& robot);

}  // namespace armcal
