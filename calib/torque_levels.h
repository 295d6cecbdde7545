#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/log_set.h"
#include "model/robot.h"

namespace armcal {

// Constants that the torque of each joint has beside the robot file's offset, N
// m or N, a vector for each log: what torques that were made of commands
// (CommandedTorque) lack of a controller's integral at a log's begin. By least
// squares over all logs, with a constant for each of them, base parameters,
// friction and armature without any prior: so that what the file has wrong of
// these does not count. What moves a joint's torque by a constant all the time
// does, and no longer shows.
std::vector<Eigen::VectorXd> TorqueLevels(const Robot& robot, LogSet* logs);

}  // namespace armcal
