#pragma once

#include <Eigen/Core>

#include "model/robot/robot.h"

namespace armcal {

// By how much weight on the tool turns each joint, at each row of joint
// positions q (rad or m): the moment about the joint's axis of a unit force
// along gravity at the tool, m; 0 for prismatic joints, which it does not turn.
// An arm with springy joints sags in proportion to it.
Eigen::MatrixXd LoadMoments(const Robot& robot, const Eigen::MatrixXd& q);

}  // namespace armcal
