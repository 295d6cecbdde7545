#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/dynamics/motion_track.h"
#include "model/dynamics/simulated_robot.h"
#include "model/signals/motion.h"

namespace armcal {

// What the motors did where encoders and the clock of `changed` said
// `recorded`, whose track is `track`. Velocities and accelerations are those of
// the positions, whatever a sensor makes of a velocity. Returns whether that
// differs from the recording; if so, also the samples' true times.
bool MotionBehindReadings(const SimulatedRobot& changed, const Motion& recorded,
                          const MotionTrack& track, Motion* motion,
                          Eigen::VectorXd* true_times);

// What torque sensors say of the torque that was commanded, samples x n.
Eigen::MatrixXd TorqueReadings(const std::vector<SensorMap>& sensors,
                               const MotionTrack& track,
                               const Eigen::MatrixXd& torque);

}  // namespace armcal
