#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/dynamics/batch_rollout.h"
#include "model/dynamics/joint_term.h"
#include "model/signals/trajectory.h"

namespace armcal {

// The Coulomb columns of all joints, for CoulombStates.
std::vector<JointTermColumn> CoulombColumns(
    const std::vector<CoulombTransition>& transitions);

// Rows first to first + length of a trajectory, as a robot would move from the
// recorded state at the first under the recorded torque.
struct ReplayedWindow {
  bool finished = false;
  // At rows first + 1 to first + length, length x n, where it is finished.
  Eigen::MatrixXd q, qd;
};

// TorqueReplay of many windows at once, by our own dynamics in lanes. Steps are
// halved until positions and velocities of a window change by less than
// `tolerance` rad or m, and 100 times that in rad/s or m/s, so that a joint
// whose friction is stiff takes no more steps than what can be seen of it.
class BatchTorqueReplay {
 public:
  // `transitions`: how each joint's Coulomb friction changes sign, n entries.
  BatchTorqueReplay(const Robot& robot,
                    std::vector<CoulombTransition> transitions,
                    const simd::Kernels& kernels = simd::BestKernels());

  int num_joints() const { return rollout_.num_joints(); }

  // As TorqueReplay's.
  const Eigen::MatrixXd& Follow(const Trajectory& trajectory) {
    return coulomb_.Follow(trajectory);
  }

  // Windows of one length, from rows `first` and the states of Coulomb friction
  // of Follow(). A window is not
  // finished that gets 100 rad (10 m) or more away from the recorded positions,
  // does not stay finite, or changes still at steps of 1/64 ms.
  std::vector<ReplayedWindow> Run(const Trajectory& trajectory,
                                  const std::vector<int>& first, int length,
                                  const Eigen::MatrixXd& coulomb,
                                  double tolerance) const;

 private:
  std::vector<ReplayedWindow> RunInSteps(const Trajectory& trajectory,
                                         const std::vector<int>& first,
                                         int length,
                                         const Eigen::MatrixXd& coulomb,
                                         int steps_per_sample) const;

  Eigen::VectorXd lost_;  // n, rad or m
  CoulombStates coulomb_;
  BatchRollout rollout_;
};

}  // namespace armcal
