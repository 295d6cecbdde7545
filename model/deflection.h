#pragma once

#include <Eigen/Core>

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
// mass matrix' diagonal, kg m^2 or kg); samples dt s apart. What the load's
// dependence on position and velocity makes of d is neglected: it is as small
// as gravity's stiffness is beside the transmission's.
Deflection FollowDeflection(const Transmission& transmission,
                            const Eigen::VectorXd& load,
                            const Eigen::VectorXd& inertia, double dt);

}  // namespace armcal
