#include "model/dynamics/inverse_dynamics.h"

#include <glog/logging.h>

#include <vector>

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Motion of a moved joint frame M and the wrench its link needs, all expressed
// in M; the acceleration is that of Mo relative to free fall.
struct LinkMotion {
  Vector3d omega = Vector3d::Zero();
  Vector3d alpha = Vector3d::Zero();
  Vector3d acceleration = Vector3d::Zero();
};
struct JointWrench {
  Vector3d force;
  Vector3d moment;  // about Mo
};

// The child's motion; X_PM is the pose of its M in the parent's M at q.
LinkMotion Propagate(const LinkMotion& parent, const Isometry3d& X_PM,
                     JointType type, double qd, double qdd) {
  const Matrix3d R_MP = X_PM.linear().transpose();
  const Vector3d z = Vector3d::UnitZ();
  const Vector3d p_PM_M = R_MP * X_PM.translation();
  LinkMotion m;
  m.omega = R_MP * parent.omega;
  m.alpha = R_MP * parent.alpha;
  m.acceleration = R_MP * parent.acceleration + m.alpha.cross(p_PM_M) +
                   m.omega.cross(m.omega.cross(p_PM_M));
  if (IsRotational(type)) {
    m.alpha += z * qdd + m.omega.cross(z * qd);
    m.omega += z * qd;
  } else {
    m.acceleration += z * qdd + 2 * m.omega.cross(z * qd);
  }
  return m;
}

JointWrench LinkWrench(const InertialParameters& V, const LinkMotion& m) {
  const Vector3d& h = V.first_moment;
  JointWrench w;
  w.force = V.mass * m.acceleration + m.alpha.cross(h) +
            m.omega.cross(m.omega.cross(h));
  w.moment = V.inertia * m.alpha + m.omega.cross(V.inertia * m.omega) +
             h.cross(m.acceleration);
  return w;
}

}  // namespace

// Motion outwards, wrenches inwards. The base accelerates by -g instead of
// gravity acting on each link. Wrenches are about each frame's own origin, in
// its own axes.
Eigen::VectorXd InverseDynamics(const Robot& robot, const Eigen::VectorXd& q,
                                const Eigen::VectorXd& qd,
                                const Eigen::VectorXd& qdd) {
  const int n = robot.num_joints();
  CHECK(q.size() == n && qd.size() == n && qdd.size() == n);
  std::vector<Isometry3d> X_PM(n);
  std::vector<JointWrench> wrench(n);
  LinkMotion at_rest;
  at_rest.acceleration = -robot.gravity;
  std::vector<LinkMotion> motion(n);
  for (int i = 0; i < n; ++i) {
    const Link& link = robot.links[i];
    const int parent = robot.parent(i);
    X_PM[i] = link.X_PF * JointTransform(link.joint.type, q[i]);
    if (parent >= 0) X_PM[i] = robot.links[parent].X_ML * X_PM[i];
    motion[i] = Propagate(parent < 0 ? at_rest : motion[parent], X_PM[i],
                          link.joint.type, qd[i], qdd[i]);
    wrench[i] = LinkWrench(link.inertial.ReexpressIn(link.X_ML), motion[i]);
  }
  Eigen::VectorXd tau(n);
  for (int i = n - 1; i >= 0; --i) {
    tau[i] = IsRotational(robot.links[i].joint.type) ? wrench[i].moment.z()
                                                     : wrench[i].force.z();
    const int parent = robot.parent(i);
    if (parent < 0) continue;
    const Vector3d force = X_PM[i].linear() * wrench[i].force;
    wrench[parent].force += force;
    wrench[parent].moment += X_PM[i].linear() * wrench[i].moment +
                             X_PM[i].translation().cross(force);
  }
  return tau;
}

}  // namespace armcal
