#include "model/robot/kinematics.h"

#include <glog/logging.h>

namespace armcal {

std::vector<Eigen::Isometry3d> LinkPoses(const Robot& robot,
                                         const Eigen::VectorXd& q) {
  CHECK_EQ(q.size(), robot.num_joints());
  std::vector<Eigen::Isometry3d> X_WL;
  for (int i = 0; i < robot.num_joints(); ++i) {
    const int parent = robot.parent(i);
    const Eigen::Isometry3d X_PL = robot.links[i].X_PL(q[i]);
    X_WL.push_back(parent < 0 ? X_PL : X_WL[parent] * X_PL);
  }
  return X_WL;
}

Eigen::Isometry3d ToolPose(const Robot& robot, const Eigen::VectorXd& q) {
  return LinkPoses(robot, q).back() * robot.X_LT;
}

}  // namespace armcal
