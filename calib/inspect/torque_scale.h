#pragma once

#include <Eigen/Core>

#include "calib/logs/wiring.h"
#include "model/robot/robot.h"

namespace armcal {

// How many times the torque that the robot file's links need is in the recorded
// one, per joint, friction and an offset apart; NaN where they need hardly any
// or the two are not alike (partial correlation below 0.7).
Eigen::VectorXd TorqueScale(const Robot& robot, const WiringSamples& samples);

}  // namespace armcal
