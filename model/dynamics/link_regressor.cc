#include "model/dynamics/link_regressor.h"

#include <glog/logging.h>

#include "model/dynamics/regressor_plan.h"
#include "model/robot/rotations.h"
#include "model/simd/kernels.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Vector6d = Eigen::Matrix<double, 6, 1>;

// I w as a matrix on Ixx, Ixy, Iyy, Ixz, Iyz, Izz.
Eigen::Matrix<double, 3, 6> InertiaTimes(const Vector3d& w) {
  Eigen::Matrix<double, 3, 6> m;
  m << w.x(), w.y(), 0, w.z(), 0, 0,  //
      0, w.x(), w.y(), 0, w.z(), 0,   //
      0, 0, 0, w.x(), w.y(), w.z();
  return m;
}

// Spatial cross product of twists.
Vector6d Cross(const Vector6d& a, const Vector6d& b) {
  Vector6d c;
  c << a.head<3>().cross(b.head<3>()),
      a.head<3>().cross(b.tail<3>()) + a.tail<3>().cross(b.head<3>());
  return c;
}

}  // namespace

LinkRegressor::LinkRegressor(const Robot& robot)
    : parents_(robot.parents), gravity_(robot.gravity) {
  for (const Link& link : robot.links) {
    joints_.push_back({link.joint.type, link.X_PF, link.X_ML});
  }
  state_.resize(joints_.size());
  plan_ =
      std::make_shared<RegressorPlan>(robot, RegressorPlan::Places::kNumbers);
}

void LinkRegressor::Propagate(const VectorXd& q, const VectorXd& qd) {
  for (int k = 0; k < num_joints(); ++k) {
    const ConstantJoint& joint = joints_[k];
    const int parent = ParentOf(parents_, k);
    JointState& s = state_[k];
    const Isometry3d X_WF =
        parent < 0 ? joint.X_PF : state_[parent].X_WL * joint.X_PF;
    const Vector3d z = X_WF.linear().col(2);
    if (IsRotational(joint.type)) {
      s.screw << z, X_WF.translation().cross(z);
    } else {
      s.screw << Vector3d::Zero(), z;
    }
    s.twist = s.screw * qd[k];
    if (parent >= 0) s.twist += state_[parent].twist;
    s.screw_change = Cross(s.twist, s.screw);
    s.X_WL = X_WF * JointTransform(joint.type, q[k]) * joint.X_ML;
  }
}

// The link's momentum about Wo by its ten parameters. In the link's axes, with
// v and w of its frame, linear = m v + w x h, angular = h x v + I w; both are
// linear in (m, h, I).
LinkRegressor::Matrix6x10 LinkRegressor::LinkMomentum(int i) const {
  const JointState& s = state_[i];
  const Matrix3d R = s.X_WL.linear();
  const Vector3d p = s.X_WL.translation();
  const Vector3d w = R.transpose() * s.twist.head<3>();
  const Vector3d v =
      R.transpose() * (s.twist.tail<3>() + s.twist.head<3>().cross(p));
  Eigen::Matrix<double, 3, 10> linear, angular;
  linear << v, CrossProductMatrix(w), Eigen::Matrix<double, 3, 6>::Zero();
  angular << Vector3d::Zero(), -CrossProductMatrix(v), InertiaTimes(w);
  Matrix6x10 h;
  h.bottomRows<3>() = R * linear;
  h.topRows<3>() = R * angular + CrossProductMatrix(p) * h.bottomRows<3>();
  return h;
}

LinkRegressor::Matrix6x10 LinkRegressor::LinkGravity(int i) const {
  const JointState& s = state_[i];
  const Matrix3d R = s.X_WL.linear();
  const Vector3d g = R.transpose() * gravity_;
  Matrix6x10 wrench = Matrix6x10::Zero();
  wrench.block<3, 1>(3, 0) = gravity_;
  wrench.block<3, 1>(0, 0) = s.X_WL.translation().cross(gravity_);
  wrench.block<3, 3>(0, 1) = -R * CrossProductMatrix(g);
  return wrench;
}

void LinkRegressor::Momentum(const VectorXd& q, const VectorXd& qd, MatrixXd* P,
                             MatrixXd* D) {
  const int n = num_joints();
  CHECK(q.size() == n && qd.size() == n);
  P->setZero(n, 10 * n);
  D->setZero(n, 10 * n);
  std::vector<const double*> motion(2 * n);
  std::vector<double*> rows(2 * n);
  for (int i = 0; i < n; ++i) {
    motion[i] = q.data() + i;
    motion[n + i] = qd.data() + i;
    rows[i] = P->data() + i;
    rows[n + i] = D->data() + i;
  }
  plan_->ForEachPath(
      {motion.data(), motion.data() + n, nullptr}, rows.data(), rows.data() + n,
      [n](auto& chain, auto& of_path, auto* some, auto* more) {
        simd::BestKernels().momentum_of_one(chain, of_path, 0, some, more, n);
      });
}

void LinkRegressor::Momentum(const VectorXd& q, const VectorXd& qd,
                             const VectorXd& V, VectorXd* PV, VectorXd* DV) {
  const int n = num_joints();
  CHECK_EQ(V.size(), 10 * n);
  Propagate(q, qd);
  PV->resize(n);
  DV->resize(n);
  std::vector<Vector6d> h(n), g(n);  // of all that joint k moves
  for (int k = 0; k < n; ++k) {
    h[k] = LinkMomentum(k) * V.segment<10>(10 * k);
    g[k] = LinkGravity(k) * V.segment<10>(10 * k);
  }
  for (int k = n - 1; k >= 0; --k) {
    const JointState& s = state_[k];
    (*PV)[k] = s.screw.dot(h[k]);
    (*DV)[k] = s.screw_change.dot(h[k]) + s.screw.dot(g[k]);
    const int parent = ParentOf(parents_, k);
    if (parent < 0) continue;
    h[parent] += h[k];
    g[parent] += g[k];
  }
}

}  // namespace armcal
