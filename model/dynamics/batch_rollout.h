#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "model/dynamics/arm_plan.h"
#include "model/simd/kernels.h"

namespace armcal {

// Where windows are; one in each row.
struct RolloutStates {
  Eigen::MatrixXd q, qd;    // windows x n
  Eigen::MatrixXd coulomb;  // states of displacement laws, -1 to 1; empty: 0
  // The step in which a window left all bounds (100 km, 1e7 rad/s) or became no
  // number, 0 for one that was none at the start; -1: it did not. It is at 0
  // from then on.
  std::vector<long> lost;
};

// Simulates many windows at once, one in each lane, with the same arm or with
// one of its own each: multiple shooting, or finite differences of one.
//
// A step is the classical Runge-Kutta one, of order 4. Where friction or
// springs of the joints are fast beside it (a light wrist), it is made linearly
// implicit in these and stays stable however fast they are: of order 3 then,
// less in what has no time to move (model/simd/motion/implicit_stages.h).
//
// A window's bits do not depend on the windows beside it. May be used by many
// threads.
class BatchRollout {
 public:
  // Of one arm for all windows; or of as many as there will be windows, of the
  // same joints and laws of friction.
  explicit BatchRollout(const std::vector<RolloutArm>& arms,
                        const simd::Kernels& kernels = simd::BestKernels());

  // Windows that go side by side.
  struct Batch {
    int first, count;  // which windows
    long step;         // how many steps are done
    double t;          // s
    // Joint j of window first + k at [j * stride + k].
    long stride;
    const double *q, *qd, *coulomb;
  };
  // The torque of a step from where it begins, N m or N, in the places of `q`;
  // linear in time from `begin` to `end`. A controller that holds its command
  // gives it twice. Asked once per step and batch.
  using TorqueLaw =
      std::function<void(const Batch& at, double* begin, double* end)>;
  // Told where each batch is after each of its steps.
  using Visit = std::function<void(const Batch& at)>;

  // Advances all windows by `steps` of `step` s; `t` of the first is `begin`.
  void Run(double begin, double step, long steps, const TorqueLaw& torque,
           const Visit& visit, RolloutStates* states) const;

  int num_joints() const { return plans_[0]->num_joints(); }

 private:
  const ArmPlan& PlanOf(int batch) const {
    return *plans_[plans_.size() == 1 ? 0 : batch];
  }

  size_t num_arms_;
  std::vector<std::unique_ptr<const ArmPlan>> plans_;  // of all, or per batch
  const simd::ArmKernels* kernels_;
};

}  // namespace armcal
