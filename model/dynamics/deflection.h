#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/dynamics/simulated_robot.h"

namespace armcal {

// How far a motor is ahead of its link, rad or m, at samples. Accelerations are
// means over a sample, so that a flank that is struck between two samples is
// not missed.
struct Deflection {
  Eigen::VectorXd angle;
  Eigen::VectorXd rate;          // rad/s or m/s
  Eigen::VectorXd acceleration;  // rad/s^2 or m/s^2
};

// The deflection d of a joint whose motor moves as recorded and whose link
// would need `load` (N m or N) to move with it, to first order in d:
//   inertia d'' + damping d' + stiffness d + T(d, d') = load,
// T the transmission's torque, and the others the load's slopes over the
// joint's own acceleration, velocity and position
// (model/dynamics/rigid_torque.h). `damping` has either sign: an arm that is
// being stretched takes energy from an oscillation of the joint that swings it,
// several times what a gear's damping takes.
struct DeflectedJoint {
  const Transmission* transmission;
  // At samples.
  Eigen::Ref<const Eigen::VectorXd> load, stiffness, damping, inertia;
};

// Of each, samples dt s apart, as many of all. Those with a FlankedSpring are
// followed several at a time; which others there are makes no difference.
std::vector<Deflection> FollowDeflections(
    const std::vector<DeflectedJoint>& joints, double dt);

}  // namespace armcal
