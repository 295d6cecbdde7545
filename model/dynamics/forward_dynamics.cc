#include "model/dynamics/forward_dynamics.h"

#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "model/dynamics/inverse_dynamics.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// The share of the largest pivot below which an inertia is rounding.
constexpr double kNoInertia = 1e-15;

// X_PM(q) of joint i, where P is the moved frame M of the joint that moves the
// link it sits on (W for the base).
Isometry3d MovedFrame(const Robot& robot, int i, double q) {
  const Link& link = robot.links[i];
  const int parent = robot.parent(i);
  const Isometry3d X_PF =
      parent < 0 ? link.X_PF : robot.links[parent].X_ML * link.X_PF;
  return X_PF * JointTransform(link.joint.type, q);
}

InertialParameters InMovedFrame(const Link& link) {
  return link.inertial.ReexpressIn(link.X_ML);
}

// Force and moment about Mo, in M.
struct BodyWrench {
  Vector3d force;
  Vector3d moment;
};

// What a unit acceleration of its joint takes of a body at rest.
BodyWrench UnitWrench(const InertialParameters& body, JointType type) {
  const Vector3d z = Vector3d::UnitZ();
  if (IsRotational(type)) return {z.cross(body.first_moment), body.inertia * z};
  return {body.mass * z, body.first_moment.cross(z)};
}

double AlongJoint(const BodyWrench& wrench, JointType type) {
  return IsRotational(type) ? wrench.moment.z() : wrench.force.z();
}

BodyWrench InParent(const BodyWrench& wrench, const Isometry3d& X_PM) {
  const Vector3d force = X_PM.linear() * wrench.force;
  return {force,
          X_PM.linear() * wrench.moment + X_PM.translation().cross(force)};
}

// Where a moved frame M is and how it moves, in M.
struct MovedBody {
  Isometry3d X_WM = Isometry3d::Identity();
  Vector3d omega = Vector3d::Zero(), v = Vector3d::Zero();
};

}  // namespace

// Column i is what a unit acceleration of joint i alone takes of all joints: it
// moves the composite of all links beyond it, whose wrench each joint on the
// way to the base takes its part of, S_j' w (Walker & Orin 1982; Featherstone
// 2008, 6.2).
Eigen::MatrixXd MassMatrix(const Robot& robot, const VectorXd& q) {
  const int n = robot.num_joints();
  CHECK_EQ(q.size(), n);
  std::vector<Isometry3d> X_PM(n);
  std::vector<InertialParameters> composite(n);
  for (int i = 0; i < n; ++i) composite[i] = InMovedFrame(robot.links[i]);
  for (int i = n - 1; i >= 0; --i) {
    X_PM[i] = MovedFrame(robot, i, q[i]);
    const int parent = robot.parent(i);
    if (parent >= 0) composite[parent] += composite[i].ReexpressIn(X_PM[i]);
  }
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    BodyWrench wrench = UnitWrench(composite[i], robot.links[i].joint.type);
    for (int j = i; j >= 0; j = robot.parent(j)) {
      M(i, j) = M(j, i) = AlongJoint(wrench, robot.links[j].joint.type);
      wrench = InParent(wrench, X_PM[j]);
    }
  }
  return M;
}

VectorXd LinkInertias(const Robot& robot, const VectorXd& q) {
  constexpr double kLeastShare = .05;
  VectorXd inertia = MassMatrix(robot, q).diagonal();
  for (int j = 0; j < inertia.size(); ++j) {
    const double both = inertia[j] + robot.links[j].joint.armature;
    inertia[j] = std::max(inertia[j], kLeastShare * std::abs(both));
  }
  return inertia;
}

VectorXd GravityTorque(const Robot& robot, const VectorXd& q) {
  const VectorXd rest = VectorXd::Zero(robot.num_joints());
  return InverseDynamics(robot, q, rest, rest);
}

VectorXd SolveInertia(const Eigen::MatrixXd& M, const VectorXd& tau) {
  const Eigen::LDLT<Eigen::MatrixXd> factor(M);
  // Eigen's solution for a pivot of zero would be a joint that does not move.
  const VectorXd pivots = factor.vectorD().cwiseAbs();
  if (!(pivots.minCoeff() > kNoInertia * pivots.maxCoeff())) {
    return VectorXd::Constant(tau.size(),
                              std::numeric_limits<double>::quiet_NaN());
  }
  return factor.solve(tau);
}

VectorXd ForwardDynamics(const Robot& robot, const VectorXd& q,
                         const VectorXd& qd, const VectorXd& tau) {
  const int n = robot.num_joints();
  CHECK_EQ(tau.size(), n);
  Eigen::MatrixXd M = MassMatrix(robot, q);
  for (int i = 0; i < n; ++i) M(i, i) += robot.links[i].joint.armature;
  return SolveInertia(M,
                      tau - InverseDynamics(robot, q, qd, VectorXd::Zero(n)));
}

// With v and omega of a body's frame, h its first moment and I its inertia
// about the frame's origin,
//   kinetic = m v'v / 2 + v'(omega x h) + omega' I omega / 2,
//   potential = -g'(m p + R h).
// No centre of mass is formed, which a link of mass 0 has none of.
ArmEnergy Energy(const Robot& robot, const VectorXd& q, const VectorXd& qd) {
  const int n = robot.num_joints();
  CHECK(q.size() == n && qd.size() == n);
  ArmEnergy energy;
  std::vector<MovedBody> bodies(n);
  for (int i = 0; i < n; ++i) {
    const int parent = robot.parent(i);
    const MovedBody before = parent < 0 ? MovedBody() : bodies[parent];
    const Isometry3d X_PM = MovedFrame(robot, i, q[i]);
    auto& [X_WM, omega, v] = bodies[i];
    X_WM = before.X_WM * X_PM;
    v = X_PM.linear().transpose() *
        (before.v + before.omega.cross(X_PM.translation()));
    omega = X_PM.linear().transpose() * before.omega;
    const bool turns = IsRotational(robot.links[i].joint.type);
    (turns ? omega : v).z() += qd[i];
    const InertialParameters body = InMovedFrame(robot.links[i]);
    energy.kinetic += 0.5 * body.mass * v.squaredNorm() +
                      v.dot(omega.cross(body.first_moment)) +
                      0.5 * omega.dot(body.inertia * omega);
    energy.potential -= robot.gravity.dot(body.mass * X_WM.translation() +
                                          X_WM.linear() * body.first_moment);
  }
  return energy;
}

}  // namespace armcal
