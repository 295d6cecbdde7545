#include "model/dynamics/proximal_chain.h"

#include <glog/logging.h>

#include <cmath>

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kExact = 1e-12;          // m or 1: already a DH row
constexpr double kNearlyParallel = 0.02;  // rad

Isometry3d RotateZ(double angle) {
  return Isometry3d(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
}

// The rotation about z (and nothing else) that makes X a DH row, if there is
// one: X = Rz(theta) Tx(a) Tz(d) Rx(alpha).
bool IsDhRow(const Isometry3d& X, double* theta) {
  const Vector3d x = X.linear().col(0);
  const Vector3d p = X.translation();
  if (std::abs(x.z()) > kExact) return false;
  if (std::abs(x.x() * p.y() - x.y() * p.x()) > kExact) return false;
  *theta = std::atan2(x.y(), x.x());
  return true;
}

Matrix3d FrameWithAxes(const Vector3d& z, const Vector3d& x_wish) {
  Matrix3d R;
  R.col(2) = z;
  R.col(0) = (x_wish - x_wish.dot(z) * z).normalized();
  R.col(1) = z.cross(R.col(0));
  return R;
}

// G_{i+1} in the moved G_i, where the next joint's fixed frame F is at X_GF:
// its origin moves along its axis, its x axis turns about it.
Isometry3d ChooseNextFrame(const Isometry3d& X_GF) {
  const Vector3d z = Vector3d::UnitZ();
  const Vector3d axis = X_GF.linear().col(2);
  const Vector3d o = X_GF.translation();
  const Vector3d normal = z.cross(axis);
  Isometry3d X_GN = Isometry3d::Identity();
  if (normal.norm() > kNearlyParallel) {
    // Foot of the common normal on the next axis: (o + s axis) x-y distance
    // along `axis` projected is stationary.
    const Vector3d e = axis - axis.z() * z;
    const double s = -o.dot(e) / e.squaredNorm();
    X_GN.translation() = o + s * axis;
    X_GN.linear() = FrameWithAxes(axis, normal);
    return X_GN;
  }
  X_GN.translation() = o - (o.z() / axis.z()) * axis;  // d = 0
  const bool coaxial = X_GN.translation().norm() < 1e-9;
  X_GN.linear() = FrameWithAxes(
      axis, coaxial ? Vector3d(X_GF.linear().col(0)) : X_GN.translation());
  return X_GN;
}

double AngleOfX(const Isometry3d& X_GN) {
  // The x axis of J: along the common normal, or towards the next axis.
  const Vector3d x = X_GN.linear().col(0);
  const Vector3d p = X_GN.translation();
  const bool use_p = std::abs(x.z()) > kExact && p.head<2>().norm() > 1e-9;
  return use_p ? std::atan2(p.y(), p.x()) : std::atan2(x.y(), x.x());
}

void AddLengths(const Robot& robot, ProximalChain* chain) {
  const bool modified = robot.dh_convention == DhConvention::kModified;
  for (int i = 0; i < robot.num_joints(); ++i) {
    const int next = robot.next(i);
    if (next < 0) continue;
    const Vector3d p = chain->joints[next].X_JG.translation();
    const std::string number = std::to_string(i + 1);
    const Link& a_row = robot.links[modified ? next : i];
    chain->lengths.push_back(
        {i, next, 0, p.x(), "a" + number, a_row.name + ".a"});
    // d of a prismatic joint is the zero of its q.
    if (!IsRotational(chain->joints[i].type)) continue;
    chain->lengths.push_back(
        {i, next, 2, p.z(), "d" + number, robot.links[i].name + ".d"});
  }
}

}  // namespace

// Goes outwards. A joint's fixed frame may be turned about and shifted along
// its axis without changing its motion; this gauge (X_FG) is used to give each
// constant the form of a DH row. What is left of it goes into the next
// constant.
ProximalChain MakeProximalChain(const Robot& robot) {
  const int n = robot.num_joints();
  CHECK_GT(n, 0);
  ProximalChain chain;
  chain.gravity = robot.gravity;
  chain.parents = robot.parents;
  chain.joints.resize(n);
  // Of each joint: the gauge, which commutes with its motion.
  std::vector<Isometry3d> X_FGs(n, Isometry3d::Identity());
  for (int i = 0; i < n; ++i) {
    const Link& link = robot.links[i];
    const int next = robot.next(i);
    const bool last = next < 0;
    // In the moved G_i: the link's frame, and the next joint's fixed frame.
    const Isometry3d X_GL = X_FGs[i].inverse() * link.X_ML;
    const Isometry3d X_GF = last ? X_GL : X_GL * robot.links[next].X_PF;
    Isometry3d X_GN = X_GF;
    double theta = 0;
    if (!IsDhRow(X_GF, &theta) && !last) {
      X_GN = ChooseNextFrame(X_GF);
      theta = AngleOfX(X_GN);
    }
    const Isometry3d X_JG = RotateZ(-theta);
    ProximalJoint& joint = chain.joints[i];
    joint.type = link.joint.type;
    joint.theta = theta;
    joint.X_JL = X_JG * X_GL;
    if (robot.parent(i) < 0) {
      joint.X_JG.setIdentity();
      joint.X_JG.linear() = link.X_PF.linear();
    }
    for (int k = i + 1; k < n; ++k) {
      if (robot.parent(k) != i) continue;
      if (k == next) X_FGs[k] = X_GF.inverse() * X_GN;
      chain.joints[k].X_JG = k == next
                                 ? Isometry3d(X_JG * X_GN)
                                 : Isometry3d(joint.X_JL * robot.links[k].X_PF);
    }
  }
  AddLengths(robot, &chain);
  return chain;
}

// Goes inwards: what does not depend on a joint's q joins the link it sits on.
// Of a turn about z that is the mass, hz, Izz and the mean of Ixx and Iyy; of a
// slide, all of the body at q = 0.
std::vector<InertialParameters> CompositeInertials(const Robot& robot,
                                                   const ProximalChain& chain) {
  const int n = robot.num_joints();
  std::vector<InertialParameters> K(n);
  for (int i = 0; i < n; ++i) {
    K[i] = robot.links[i].inertial.ReexpressIn(chain.joints[i].X_JL);
  }
  for (int i = n - 1; i >= 0; --i) {
    const int parent = ParentOf(chain.parents, i);
    if (parent < 0) continue;
    const ProximalJoint& joint = chain.joints[i];
    InertialParameters red = K[i];
    if (IsRotational(joint.type)) {  // what a turn about z leaves unchanged
      const double J = 0.5 * (red.inertia(0, 0) + red.inertia(1, 1));
      red.first_moment.head<2>().setZero();
      red.inertia = Eigen::Vector3d(J, J, K[i].inertia(2, 2)).asDiagonal();
    } else {
      red = red.ReexpressIn(RotateZ(joint.theta));
    }
    K[parent] += red.ReexpressIn(joint.X_JG);
  }
  return K;
}

}  // namespace armcal
