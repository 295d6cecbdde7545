#pragma once

#include <Eigen/Core>

#include "model/robot/robot.h"

namespace armcal {

// Of the rigid links, as InverseDynamics: no friction, and armature only where
// a function says so. Vectors have n entries, rad and N m (m and N for
// prismatic joints).

// M(q), n x n, by composite rigid bodies (Featherstone 2008, section 6.2).
Eigen::MatrixXd MassMatrix(const Robot& robot, const Eigen::VectorXd& q);

// Inertia about each joint of what lies beyond it, the other joints held, kg
// m^2 or kg. A log does not tell it from armature, so that fitted links may
// claim less than nothing: at least a twentieth of both together.
Eigen::VectorXd LinkInertias(const Robot& robot, const Eigen::VectorXd& q);

// The torque that holds the arm at rest at q.
Eigen::VectorXd GravityTorque(const Robot& robot, const Eigen::VectorXd& q);

// M^-1 tau of a mass matrix with whatever was added to it, n x n; NaN where no
// inertia resists a joint.
Eigen::VectorXd SolveInertia(const Eigen::MatrixXd& M,
                             const Eigen::VectorXd& tau);

// qdd that `tau` gives the links and their joints' armature at (q, qd). NaN
// where no inertia resists a joint.
Eigen::VectorXd ForwardDynamics(const Robot& robot, const Eigen::VectorXd& q,
                                const Eigen::VectorXd& qd,
                                const Eigen::VectorXd& tau);

// J. The potential energy's zero is that of masses at Wo.
struct ArmEnergy {
  double kinetic = 0;
  double potential = 0;

  double total() const { return kinetic + potential; }
};
// Of the links, without armature.
ArmEnergy Energy(const Robot& robot, const Eigen::VectorXd& q,
                 const Eigen::VectorXd& qd);

}  // namespace armcal
