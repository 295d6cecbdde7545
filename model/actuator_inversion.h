#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/motion_track.h"
#include "model/simulated_robot.h"

namespace armcal {

// What the motors give for commands along a motion, samples x n, N m or N.
// States have settled on the first sample.
Eigen::MatrixXd GivenTorque(const std::vector<ActuatorMap>& actuators,
                            const MotionTrack& track,
                            const Eigen::MatrixXd& commanded);

// The commands for which the motors give what is `needed`. Starts from `guess`;
// where maps can be inverted the result is that of needed torque alone. Where
// they lose what was asked, as at a limit, it is the guess plus what is missing
// there: recorded torque is a good guess, and the needed one a poor.
Eigen::MatrixXd CommandFor(const std::vector<ActuatorMap>& actuators,
                           const MotionTrack& track,
                           const Eigen::MatrixXd& needed,
                           const Eigen::MatrixXd& guess);

}  // namespace armcal
