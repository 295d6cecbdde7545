#pragma once

#include <Eigen/Core>
#include <memory>

#include "model/arm_plan.h"
#include "model/simd/kernels.h"

namespace armcal {

// Where an arm was at the stages of Runge-Kutta steps, four rows a step.
struct StageMotion {
  static constexpr int kStages = 4;
  Eigen::MatrixXd q, qd, qdd;  // rad, rad/s, rad/s^2, or m

  void Resize(long steps, int n);
};

// Classical Runge-Kutta steps of an arm whose joints have viscous and Coulomb
// friction by velocity laws, offset and armature, and whose stages can be kept:
// what derivatives are taken of. Steps are explicit: SafeStep() says how short.
// Use one per thread.
class StageStepper {
 public:
  explicit StageStepper(const RolloutArm& arm,
                        const simd::Kernels& kernels = simd::BestKernels());

  int num_joints() const { return static_cast<int>(q_.size()); }
  const Eigen::VectorXd& q() const { return q_; }
  const Eigen::VectorXd& qd() const { return qd_; }
  void SetState(const Eigen::VectorXd& q, const Eigen::VectorXd& qd);

  // Advances by `step` s under the torque at its begin, middle and end (columns
  // of n x 3, N m or N); keeps its stages from row `row` on unless null. False
  // where the state is of no use any more.
  bool Advance(double step, const Eigen::MatrixXd& torque, long row,
               StageMotion* kept);

  // The longest step, s, that friction leaves accurate and stable.
  double SafeStep(const Eigen::VectorXd& q) const;

 private:
  RolloutArm arm_;
  std::shared_ptr<const ArmPlan> plan_;
  const simd::ArmKernels* kernels_;
  Eigen::VectorXd q_, qd_;
  Eigen::VectorXd stage_q_, stage_qd_, rate_, tau_, sum_q_, sum_qd_;
};

}  // namespace armcal
