#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/dynamics/arm_dynamics.h"
#include "model/dynamics/joint_term.h"
#include "model/robot/robot.h"
#include "model/signals/integration.h"
#include "model/signals/trajectory.h"

namespace armcal {

// What an arm does under recorded torque: an engine's rigid links with the
// viscous and Coulomb friction, the offset and the armature of `robot`'s joints
// (joint_term.h). Keeps scratch, so use one per thread.
class TorqueReplay {
 public:
  // `transitions`: how each joint's Coulomb friction changes sign, n entries.
  // `dynamics` is `robot`'s and must outlive this.
  TorqueReplay(const Robot& robot, std::vector<CoulombTransition> transitions,
               ArmDynamics* dynamics);

  int num_joints() const { return dynamics_->num_joints(); }

  // The states of Coulomb friction along the recorded motion, samples x n:
  // where a replay that starts at one of its samples begins. Trajectories of a
  // log come in their order.
  const Eigen::MatrixXd& Follow(const Trajectory& trajectory) {
    return coulomb_.Follow(trajectory);
  }

  // From the recorded state at row `first`, with `coulomb` of Follow(), to row
  // `last`; the torque is linear between samples. Rows of x: q, qd and the
  // states of Coulomb friction at rows first + 1 .. last, as far as it came: it
  // ends where a joint is 100 rad (10 m) or more from the recorded position.
  Integration Run(const Trajectory& trajectory, int first, int last,
                  const Eigen::VectorXd& coulomb,
                  const IntegrationOptions& options);

 private:
  bool IsLost(const Eigen::VectorXd& recorded, const Eigen::VectorXd& x) const;
  void Rate(const Eigen::VectorXd& tau, const Eigen::VectorXd& x,
            Eigen::VectorXd* rate);

  Robot robot_;
  std::vector<CoulombTransition> transitions_;
  ArmDynamics* dynamics_;
  CoulombStates coulomb_;
  ArmTerms terms_;
};

}  // namespace armcal
