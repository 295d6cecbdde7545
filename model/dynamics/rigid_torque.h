#pragma once

#include <Eigen/Core>
#include <list>
#include <utility>
#include <vector>

#include "model/dynamics/joint_term.h"
#include "model/dynamics/motion_columns.h"
#include "model/robot/robot.h"
#include "model/signals/motion.h"

namespace armcal {

// What the torque of a robot along a motion is made of, samples x n, N m or N.

// Of the links: recursive Newton-Euler, in lanes.
Eigen::MatrixXd LinkTorque(const Robot& robot, const Motion& motion);
Eigen::MatrixXd LinkTorque(const Robot& robot, const MotionColumns& motion,
                           int samples);
// Its slopes: of each joint's torque over that joint's own position, velocity
// and acceleration, samples x n, N m/rad, N m s/rad, kg m^2, or of a prismatic
// joint. Inertias are LinkInertias (model/dynamics/forward_dynamics.h).
struct LinkTorqueSlopes {
  Eigen::MatrixXd stiffness, damping, inertia;
};
LinkTorqueSlopes SlopesOfLinkTorque(const Robot& robot, const Motion& motion);
// The joints' states of Coulomb friction, -1 to 1.
Eigen::MatrixXd CoulombAlong(const std::vector<CoulombTransition>& transitions,
                             const Motion& motion);
// Viscous and Coulomb friction, with those states, and offsets.
Eigen::MatrixXd FrictionTorque(const Robot& robot, const Motion& motion,
                               const Eigen::MatrixXd& coulomb);
void AddArmature(const Robot& robot, const Motion& motion,
                 Eigen::MatrixXd* tau);

// Whether two robots have the same torques of links; of joint terms.
bool SameLinks(const Robot& a, const Robot& b);
bool SameJointTerms(const Robot& a, const Robot& b);

// Torques of the links of several robots along the same motion, each worked out
// once: what is asked of many robots is mostly asked of few links.
class LinkTorques {
 public:
  // `load`: LinkTorque(robot, motion). All robots must outlive this.
  LinkTorques(const Robot& robot, const Eigen::MatrixXd& load,
              const Motion& motion)
      : robot_(robot), load_(load), motion_(motion) {}
  // Where it stays for as long as this does.
  const Eigen::MatrixXd& Of(const Robot& robot);

 private:
  const Robot& robot_;
  const Eigen::MatrixXd& load_;
  const Motion& motion_;
  std::list<std::pair<const Robot*, Eigen::MatrixXd>> others_;
};

}  // namespace armcal
