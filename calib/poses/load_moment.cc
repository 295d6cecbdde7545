#include "calib/poses/load_moment.h"

#include <vector>

#include "model/robot/kinematics.h"

namespace armcal {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Eigen::MatrixXd LoadMoments(const Robot& robot, const Eigen::MatrixXd& q) {
  const Vector3d down = robot.gravity.stableNormalized();
  Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(q.rows(), q.cols());
  for (Eigen::Index k = 0; k < q.rows(); ++k) {
    const Eigen::VectorXd position = q.row(k);
    const std::vector<Isometry3d> X_WL = LinkPoses(robot, position);
    const Vector3d p_WT = (X_WL.back() * robot.X_LT).translation();
    Isometry3d X_WP = Isometry3d::Identity();
    for (int i = 0; i < robot.num_joints(); ++i) {
      const Isometry3d X_WF = X_WP * robot.links[i].X_PF;
      X_WP = X_WL[i];
      if (!IsRotational(robot.links[i].joint.type)) continue;
      moments(k, i) = X_WF.linear().col(2).dot(
          Vector3d(p_WT - X_WF.translation()).cross(down));
    }
  }
  return moments;
}

}  // namespace armcal
