#include "model/plant/hidden/joint_axes.h"

namespace armcal {

namespace {

constexpr double kParallel = 1e-6;

// Whether one of the revolute axes up to the joint is not along `direction`
// (zero: the first of the axes).
bool Leaves(const SimulatedRobot& robot, int joint, Eigen::Vector3d direction) {
  Eigen::Isometry3d X_WL = Eigen::Isometry3d::Identity();
  for (int j = 0; j <= robot.num_passive + joint; ++j) {
    const Link& link = robot.robot.links[j];
    const Eigen::Vector3d axis = (X_WL * link.X_PF).linear().col(2);
    X_WL = X_WL * link.X_PL(0);
    if (!IsRotational(link.joint.type)) continue;
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
