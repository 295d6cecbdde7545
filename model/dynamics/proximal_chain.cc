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
  for (int i = 0; i + 1 < robot.num_joints(); ++i) {
    const ProximalJoint& joint = chain->joints[i];
    const std::string number = std::to_string(i + 1);
    const Link& a_row = robot.links[modified ? i + 1 : i];
    chain->lengths.push_back(
        {i, 0, joint.p.x(), "a" + number, a_row.name + ".a"});
    // d of a prismatic joint is the zero of its q.
    if (!IsRotational(joint.type)) continue;
    chain->lengths.push_back(
        {i, 2, joint.p.z(), "d" + number, robot.links[i].name + ".d"});
  }
}

}  // namespace

ProximalChain MakeProximalChain(const Robot& robot) {
  const int n = robot.num_joints();
  CHECK_GT(n, 0);
  ProximalChain chain;
  chain.gravity = robot.links[0].X_PF.linear().transpose() * robot.gravity;
  Isometry3d X_FG = Isometry3d::Identity();  // the gauge; commutes with motion
  for (int i = 0; i < n; ++i) {
    const Link& link = robot.links[i];
    const bool last = i + 1 == n;
    // In the moved G_i: the link's frame, and the next joint's fixed frame.
    const Isometry3d X_GL = X_FG.inverse() * link.X_ML;
    const Isometry3d X_GF = last ? X_GL : X_GL * robot.links[i + 1].X_PF;
    Isometry3d X_GN = X_GF;
    double theta = 0;
    if (!IsDhRow(X_GF, &theta) && !last) {
      X_GN = ChooseNextFrame(X_GF);
      theta = AngleOfX(X_GN);
    }
    const Isometry3d X_JG = RotateZ(-theta);
    const Isometry3d C = X_JG * X_GN;
    ProximalJoint joint{link.joint.type, theta, C.linear(), C.translation(),
                        X_JG * X_GL};
    if (last) {
      joint.R.setIdentity();
      joint.p.setZero();
    }
    chain.joints.push_back(joint);
    X_FG = X_GF.inverse() * X_GN;
  }
  AddLengths(robot, &chain);
  return chain;
}

std::vector<InertialParameters> CompositeInertials(const Robot& robot,
                                                   const ProximalChain& chain) {
  const int n = robot.num_joints();
  std::vector<InertialParameters> K(n);
  for (int i = n - 1; i >= 0; --i) {
    K[i] = robot.links[i].inertial.ReexpressIn(chain.joints[i].X_JL);
    if (i + 1 == n) continue;
    const ProximalJoint& next = chain.joints[i + 1];
    InertialParameters red = K[i + 1];
    if (IsRotational(next.type)) {  // what a turn about z leaves unchanged
      const double J = 0.5 * (red.inertia(0, 0) + red.inertia(1, 1));
      red.first_moment.head<2>().setZero();
      red.inertia = Eigen::Vector3d(J, J, K[i + 1].inertia(2, 2)).asDiagonal();
    } else {
      red = red.ReexpressIn(RotateZ(next.theta));
    }
    Isometry3d C = Isometry3d::Identity();
    C.linear() = chain.joints[i].R;
    C.translation() = chain.joints[i].p;
    K[i] += red.ReexpressIn(C);
  }
  return K;
}

}  // namespace armcal
