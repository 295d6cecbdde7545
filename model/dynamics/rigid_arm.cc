#include "model/dynamics/rigid_arm.h"

#include <glog/logging.h>

#include <utility>

#include "model/dynamics/arm_plan.h"
#include "model/robot/kinematics.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

ArmTerms::Point PointAt(const Robot& robot, const std::vector<Isometry3d>& X_WL,
                        const Attachment& attachment) {
  ArmTerms::Point point;
  point.X_WP = X_WL[attachment.link];
  point.X_WP.translation() = point.X_WP * attachment.p_LP;
  point.jacobian.setZero(6, robot.num_joints());
  for (int j = attachment.link; j >= 0; j = robot.parent(j)) {
    const Isometry3d X_WM = X_WL[j] * robot.links[j].X_ML.inverse();
    const Vector3d axis = X_WM.linear().col(2);
    if (IsRotational(robot.links[j].joint.type)) {
      point.jacobian.col(j) << axis,
          axis.cross(point.X_WP.translation() - X_WM.translation());
    } else {
      point.jacobian.col(j).tail<3>() = axis;
    }
  }
  return point;
}

}  // namespace

RigidArm::RigidArm(Robot robot, const simd::Kernels& kernels)
    : robot_(std::move(robot)),
      plan_(std::make_shared<ArmPlan>(RolloutArm{robot_, {}, {}},
                                      kernels.one_arm.lanes)),
      kernels_(&kernels.one_arm) {}

void RigidArm::Evaluate(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                        const std::vector<Attachment>& attachments,
                        ArmTerms* terms) {
  const int n = num_joints();
  CHECK(q.size() == n && qd.size() == n);
  terms->mass_matrix.resize(n, n);
  terms->bias.resize(n);
  kernels_->terms(plan_->constants(), q.data(), qd.data(), 1,
                  terms->mass_matrix.data(), terms->bias.data());
  terms->points.clear();
  if (attachments.empty()) return;
  const std::vector<Isometry3d> X_WL = LinkPoses(robot_, q);
  for (const Attachment& attachment : attachments) {
    terms->points.push_back(PointAt(robot_, X_WL, attachment));
  }
}

}  // namespace armcal
