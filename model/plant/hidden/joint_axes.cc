#include "model/plant/hidden/joint_axes.h"

#include "model/robot/kinematics.h"

namespace armcal {

namespace {

constexpr double kParallel = 1e-6;

// Whether one of the revolute axes up to the joint is not along `direction`
// (zero: the first of the axes).
bool Leaves(const SimulatedRobot& robot, int joint, Eigen::Vector3d direction) {
  const std::vector<Eigen::Isometry3d> X_WL =
      LinkPoses(robot.robot, Eigen::VectorXd::Zero(robot.robot.num_joints()));
  for (int j = robot.num_passive + joint; j >= 0; j = robot.robot.parent(j)) {
    const Link& link = robot.robot.links[j];
    if (!IsRotational(link.joint.type)) continue;
    const Eigen::Vector3d axis =
        (X_WL[j] * link.X_ML.inverse()).linear().col(2);
    if (direction.isZero()) direction = axis;
    if (axis.cross(direction.normalized()).norm() > kParallel) return true;
  }
  return false;
}

}  // namespace

std::string WhyTurnsAboutOneAxis(const SimulatedRobot& robot, int joint) {
  return Leaves(robot, joint, Eigen::Vector3d::Zero())
             ? ""
             : "the link turns about one axis only";
}

std::string WhyGravityIsAlongItsAxes(const SimulatedRobot& robot, int joint) {
  const Eigen::Vector3d& gravity = robot.robot.gravity;
  return !gravity.isZero() && Leaves(robot, joint, gravity)
             ? ""
             : "gravity has no moment about the joints that carry the link";
}

}  // namespace armcal
