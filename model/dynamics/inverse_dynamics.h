#pragma once

#include <Eigen/Core>

#include "model/robot/robot.h"

namespace armcal {

// Joint torques (N m, or N for prismatic joints) that move the rigid arm with
// qdd at (q, qd): recursive Newton-Euler (Luh, Walker, Paul 1980). Gravity and
// the links' inertial parameters are the robot's; friction and armature are
// not included. All vectors have n entries. Shares no code with
// model_parameters, which it is the referee of.
Eigen::VectorXd InverseDynamics(const Robot& robot, const Eigen::VectorXd& q,
                                const Eigen::VectorXd& qd,
                                const Eigen::VectorXd& qdd);

}  // namespace armcal
