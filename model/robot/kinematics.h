#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "model/robot/robot.h"

namespace armcal {

// X_WL of every link at joint positions q (n, rad or m), base to tip.
std::vector<Eigen::Isometry3d> LinkPoses(const Robot& robot,
                                         const Eigen::VectorXd& q);

// X_WT, the pose of the tool frame at q.
Eigen::Isometry3d ToolPose(const Robot& robot, const Eigen::VectorXd& q);

}  // namespace armcal
