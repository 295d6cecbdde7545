#pragma once

// Truth for derivatives by geometric parameters: an arm's poses written out
// from its parameters' names, its equations by d'Alembert and Lagrange from
// these poses alone, all derivatives automatic.

#include <map>
#include <string>
#include <vector>

#include "model/robot/arm_geometry.h"
#include "tests/model/dynamics/dual_pose.h"

namespace armcal {

class ParticleArm {
 public:
  // `robot` with the geometry `values` of ArmGeometry(file).
  ParticleArm(const Robot& robot, const Robot& file,
              const Eigen::VectorXd& values)
      : robot_(robot), file_(file), names_(ArmGeometry(file).Names()) {
    for (size_t k = 0; k < names_.size(); ++k) {
      values_[names_[k]] = ByParameter(values[static_cast<int>(k)]);
    }
  }

  // Columns of tau, P and D by parameter k at one sample.
  struct Columns {
    Eigen::VectorXd tau, P, D;
  };
  Columns By(int k, const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
             const Eigen::VectorXd& qdd) {
    values_[names_[k]].d = 1;
    const int n = robot_.num_joints();
    Columns columns = {q, q, q};
    const auto moving = Poses(q, qd, qd, qdd);  // .d.d: second rate
    for (int j = 0; j < n; ++j) {
      const Eigen::VectorXd unit = Eigen::VectorXd::Unit(n, j);
      const auto turned = Poses(q, unit, qd, Eigen::VectorXd::Zero(n));
      ByParameter tau = 0., P = 0., D = 0.;
      for (int i = 0; i < n; ++i) {
        AddBody(robot_.links[i].inertial, turned[i], moving[i], &tau, &P, &D);
      }
      columns.tau[j] = tau.d;
      columns.P[j] = P.d;
      columns.D[j] = D.d;
    }
    values_[names_[k]].d = 0;
    return columns;
  }

 private:
  // Of the links, q moving in one way, in another, and in both.
  std::vector<DualPose> Poses(const Eigen::VectorXd& q,
                              const Eigen::VectorXd& one,
                              const Eigen::VectorXd& other,
                              const Eigen::VectorXd& both) const {
    DualPose X;
    AddPose("base", &X);
    std::vector<DualPose> poses;
    for (int i = 0; i < robot_.num_joints(); ++i) {
      const ByJoint at({ByParameter(q[i]), ByParameter(other[i])},
                       {ByParameter(one[i]), ByParameter(both[i])});
      AddLink(file_.links[i], at, &X);
      poses.push_back(X);
    }
    return poses;
  }
  ByJoint Value(const std::string& name) const {
    ByJoint value(0.);
    const auto at = values_.find(name);
    if (at != values_.end()) value.v.v = at->second;
    return value;
  }
  void AddPose(const std::string& owner, DualPose* X) const {
    for (int k = 0; k < 3; ++k) X->Shift(k, Value(owner + "." + "xyz"[k]));
    X->Turn(2, Value(owner + ".yaw"));
    X->Turn(1, Value(owner + ".pitch"));
    X->Turn(0, Value(owner + ".roll"));
  }
  void Move(const Link& link, const ByJoint& q, DualPose* X) const {
    IsRotational(link.joint.type) ? X->Turn(2, q) : X->Shift(2, q);
  }
  void AddLink(const Link& link, const ByJoint& q, DualPose* X) const {
    const auto value = [&](const char* name) {
      return Value(link.name + "." + name);
    };
    if (!file_.dh_convention) {
      AddPose(link.name, X);
      *X = *X * DualPose(link.X_ML.inverse());
      Move(link, q + value("theta"), X);
      *X = *X * DualPose(link.X_ML);
    } else if (*file_.dh_convention == DhConvention::kStandard) {
      Move(link, q, X);
      X->Turn(2, value("theta"));
      X->Shift(2, value("d"));
      X->Shift(0, value("a"));
      X->Turn(0, value("alpha"));
      X->Turn(1, value("beta"));
    } else {
      X->Turn(0, value("alpha"));
      X->Turn(1, value("beta"));
      X->Shift(0, value("a"));
      Move(link, q, X);
      X->Turn(2, value("theta"));
      X->Shift(2, value("d"));
    }
  }
  // With X the body's pose and S the sum of m [x; 1] [x; 1]' over its
  // particles: tau = tr(dX/dq S (X'' - g)'), P = tr(dX/dq S X''), and D that of
  // the kinetic energy's change, tr(dX'/dq S X''), and of the weight's.
  void AddBody(const InertialParameters& V, const DualPose& turned,
               const DualPose& moving, ByParameter* tau, ByParameter* P,
               ByParameter* D) const {
    Eigen::Matrix4d S;
    S << V.inertia.trace() / 2 * Eigen::Matrix3d::Identity() - V.inertia,
        V.first_moment, V.first_moment.transpose(), V.mass;
    for (int row = 0; row < 3; ++row) {
      for (int a = 0; a < 4; ++a) {
        const ByJoint& x = turned.m[row][a];
        for (int b = 0; b < 4; ++b) {
          const ByParameter s = S(a, b);
          const ByJoint &y = turned.m[row][b], &z = moving.m[row][b];
          *tau = *tau + s * x.d.v * z.d.d;
          *P = *P + s * x.d.v * y.v.d;
          *D = *D + s * x.d.d * y.v.d;
        }
        const ByParameter weight = S(a, 3) * robot_.gravity[row];
        *tau = *tau + ByParameter(-1.) * weight * x.d.v;
        *D = *D + weight * x.d.v;
      }
    }
  }

  Robot robot_, file_;
  std::vector<std::string> names_;
  std::map<std::string, ByParameter> values_;
};

}  // namespace armcal
