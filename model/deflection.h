#pragma once

#include <Eigen/Core>

#include "model/simulated_robot.h"

namespace armcal {

// How far a motor is ahead of its link, samples, rad or m and per s, s^2.
struct Deflection {
  Eigen::VectorXd angle;
  Eigen::VectorXd rate;
  Eigen::VectorXd acceleration;
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
