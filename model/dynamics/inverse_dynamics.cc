#include "model/dynamics/inverse_dynamics.h"

#include <glog/logging.h>

#include <vector>

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// The child's motion; X_PM is the pose of its M in the parent's M at q.
RigidMotion Propagate(const RigidMotion& parent, const Isometry3d& X_PM,
                      JointType type, double qd, double qdd) {
  const Matrix3d R_MP = X_PM.linear().transpose();
  const Vector3d z = Vector3d::UnitZ();
  const Vector3d p_PM_M = R_MP * X_PM.translation();
  RigidMotion m;
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

// The pose of the M of link i in the M of its parent, or in the world.
Isometry3d JointPose(const Robot& robot, int i, double q) {
  const Link& link = robot.links[i];
  const int parent = robot.parent(i);
  const Isometry3d X_PM = link.X_PF * JointTransform(link.joint.type, q);
  return parent >= 0 ? robot.links[parent].X_ML * X_PM : X_PM;
}

// The base accelerates by -g instead of gravity acting on each link.
RigidMotion BaseMotion(const Robot& robot) {
  RigidMotion base;
  base.acceleration = -robot.gravity;
  return base;
}

}  // namespace

RigidWrench WrenchOf(const InertialParameters& V, const RigidMotion& m) {
  const Vector3d& h = V.first_moment;
  RigidWrench w;
  w.force = V.mass * m.acceleration + m.alpha.cross(h) +
            m.omega.cross(m.omega.cross(h));
  w.moment = V.inertia * m.alpha + m.omega.cross(V.inertia * m.omega) +
             h.cross(m.acceleration);
  return w;
}

RigidMotion LastLinkMotion(const Robot& robot, const Eigen::VectorXd& q,
                           const Eigen::VectorXd& qd,
                           const Eigen::VectorXd& qdd) {
  const int n = robot.num_joints();
  CHECK(n > 0 && !robot.branches());
  CHECK(q.size() == n && qd.size() == n && qdd.size() == n);
  RigidMotion motion = BaseMotion(robot);
  for (int i = 0; i < n; ++i) {
    motion = Propagate(motion, JointPose(robot, i, q[i]),
                       robot.links[i].joint.type, qd[i], qdd[i]);
  }
  // From the moved joint frame M to L, another frame of the same body.
  const Isometry3d& X_ML = robot.links.back().X_ML;
  const Matrix3d R_LM = X_ML.linear().transpose();
  const Vector3d& p_M_L = X_ML.translation();
  RigidMotion last;
  last.omega = R_LM * motion.omega;
  last.alpha = R_LM * motion.alpha;
  last.acceleration = R_LM * (motion.acceleration + motion.alpha.cross(p_M_L) +
                              motion.omega.cross(motion.omega.cross(p_M_L)));
  return last;
}

// Motion outwards, wrenches inwards. Wrenches are about each frame's own
// origin, in its own axes.
Eigen::VectorXd InverseDynamics(const Robot& robot, const Eigen::VectorXd& q,
                                const Eigen::VectorXd& qd,
                                const Eigen::VectorXd& qdd) {
  const int n = robot.num_joints();
  CHECK(q.size() == n && qd.size() == n && qdd.size() == n);
  std::vector<Isometry3d> X_PM(n);
  std::vector<RigidWrench> wrench(n);
  const RigidMotion base = BaseMotion(robot);
  std::vector<RigidMotion> motion(n);
  for (int i = 0; i < n; ++i) {
    const Link& link = robot.links[i];
    const int parent = robot.parent(i);
    X_PM[i] = JointPose(robot, i, q[i]);
    motion[i] = Propagate(parent < 0 ? base : motion[parent], X_PM[i],
                          link.joint.type, qd[i], qdd[i]);
    wrench[i] = WrenchOf(link.inertial.ReexpressIn(link.X_ML), motion[i]);
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
