#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/dynamics/motion_track.h"
#include "model/dynamics/simulated_robot.h"

namespace armcal {

// What the motors give for commands along a motion, samples x n, N m or N.
// States have settled on the first sample.
Eigen::MatrixXd GivenTorque(const std::vector<ActuatorMap>& actuators,
                            const MotionTrack& track,
                            const Eigen::MatrixXd& commanded);

// The commands for which the motors give what is `needed`, map by map from the
// last. Where a map can be inverted they are those of the needed torque alone.
// Where it loses what was asked, as at a limit, they are the `guess` plus what
// is missing then: the recorded torque, or (empty) the needed one, which is a
// poor guess.
Eigen::MatrixXd CommandFor(const std::vector<ActuatorMap>& actuators,
                           const MotionTrack& track,
                           const Eigen::MatrixXd& needed,
                           const Eigen::MatrixXd& guess);

}  // namespace armcal
