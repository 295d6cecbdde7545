#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/simulated_robot.h"

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
// would need `load` (N m or N) to move with it:
//   inertia d'' + T(d, d') = load,
// T the transmission's torque and `inertia` that of all the joint carries (the
// mass matrix' diagonal, kg m^2 or kg). What the load's dependence on position
// and velocity makes of d is neglected: it is as small as gravity's stiffness
// is beside the transmission's.
struct DeflectedJoint {
  const Transmission* transmission;
  Eigen::Ref<const Eigen::VectorXd> load, inertia;  // at samples
};

// Of each, samples dt s apart, as many of all. Those with a FlankedSpring are
// followed several at a time; which others there are makes no difference.
std::vector<Deflection> FollowDeflections(
    const std::vector<DeflectedJoint>& joints, double dt);

}  // namespace armcal
