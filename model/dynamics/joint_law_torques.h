#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/dynamics/motion_track.h"
#include "model/dynamics/simulated_robot.h"

namespace armcal {

// Torque of each law at every sample of a motion, N m or N, with its states
// along it. What laws see at an instant is made once for all of them, and
// copies of one law are followed once; which others there are makes no
// difference.
std::vector<Eigen::VectorXd> JointLawTorques(
    const std::vector<const JointLaw*>& laws, const MotionTrack& track);

}  // namespace armcal
