#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/dynamics/arm_dynamics.h"
#include "model/dynamics/motion_track.h"
#include "model/dynamics/simulated_robot.h"
#include "model/robot/robot.h"

namespace armcal {

// An attachment along the motion of a rigid arm, sample by sample.
struct AttachedPoints {
  Attachment attachment;
  std::vector<ArmTerms::Point> at;  // empty: not followed yet
};
AttachedPoints FollowPoints(const Robot& robot, const MotionTrack& track,
                            const Attachment& attachment);

// Takes from the torques tau (samples x n, N m or N) what the law's wrench
// gives to the joints, J^T F.
void TakeWrench(const WrenchLaw& law, const MotionTrack& track,
                const std::vector<ArmTerms::Point>& points,
                Eigen::MatrixXd* tau);

}  // namespace armcal
