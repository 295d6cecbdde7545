#pragma once

#include <Eigen/Core>
#include <cmath>

#include "model/robot.h"
#include "model/trajectory.h"

namespace armcal {

// Two revolute links in a vertical plane with its equations from the textbook
// (Spong, Hutchinson, Vidyasagar, Robot Modeling and Control, section 7.4):
// gravity along -y, lc the distance of a link's centre of mass from its joint.
struct TwoLinkArm {
  double m1 = 4, m2 = 2.5;     // kg
  double l1 = .5, l2 = .4;     // m
  double lc1 = .2, lc2 = .15;  // m
  double I1 = .12, I2 = .05;   // kg m^2 about the centre of mass
  double g = 9.81;             // m/s^2
  double viscous = 0;          // N m s/rad, of both joints

  Eigen::Vector2d Torque(const Eigen::Vector2d& q, const Eigen::Vector2d& qd,
                         const Eigen::Vector2d& qdd) const {
    const double c2 = std::cos(q[1]), c1 = std::cos(q[0]);
    const double c12 = std::cos(q[0] + q[1]);
    const double h = -m2 * l1 * lc2 * std::sin(q[1]);
    const double d11 = m1 * lc1 * lc1 +
                       m2 * (l1 * l1 + lc2 * lc2 + 2 * l1 * lc2 * c2) + I1 + I2;
    const double d12 = m2 * (lc2 * lc2 + l1 * lc2 * c2) + I2;
    const double d22 = m2 * lc2 * lc2 + I2;
    return {d11 * qdd[0] + d12 * qdd[1] + 2 * h * qd[0] * qd[1] +
                h * qd[1] * qd[1] + (m1 * lc1 + m2 * l1) * g * c1 +
                m2 * lc2 * g * c12 + viscous * qd[0],
            d12 * qdd[0] + d22 * qdd[1] - h * qd[0] * qd[0] +
                m2 * lc2 * g * c12 + viscous * qd[1]};
  }

  // As a DH table: link frames lie at the links' far ends.
  Robot ToRobot() const {
    Robot robot;
    robot.gravity = {0, -g, 0};
    robot.dh_convention = DhConvention::kStandard;
    robot.links.resize(2);
    const double length[] = {l1, l2}, mass[] = {m1, m2}, centre[] = {lc1, lc2},
                 I[] = {I1, I2};
    for (int i = 0; i < 2; ++i) {
      Link& link = robot.links[i];
      link.name = "link" + std::to_string(i + 1);
      SetDhPose({length[i], 0, 0, 0}, DhConvention::kStandard, &link);
      link.inertial = InertialParameters::FromCenterOfMass(
          mass[i], {centre[i] - length[i], 0, 0},
          Eigen::Vector3d(.01, I[i], I[i]).asDiagonal());
      link.joint.viscous = viscous;
    }
    return robot;
  }

  // A smooth motion and its exact derivatives.
  static void Motion(double t, Eigen::Vector2d* q, Eigen::Vector2d* qd,
                     Eigen::Vector2d* qdd) {
    const Eigen::Array2d A(.9, .7), w(3.1, 4.7), p(.3, 1.1);
    *q = A * (w * t + p).sin() + Eigen::Array2d(.2, -.5);
    *qd = A * w * (w * t + p).cos();
    *qdd = -A * w * w * (w * t + p).sin();
  }

  // Exact samples first_index .. first_index + n - 1 of that motion, all core.
  Trajectory Record(double dt, int n, long first_index = 0) const {
    Trajectory t;
    t.t0 = first_index * dt;
    t.dt = dt;
    for (Eigen::MatrixXd* x : {&t.q, &t.qd, &t.qdd, &t.tau}) x->resize(n, 2);
    for (int k = 0; k < n; ++k) {
      Eigen::Vector2d q, qd, qdd;
      Motion((first_index + k) * dt, &q, &qd, &qdd);
      t.q.row(k) = q;
      t.qd.row(k) = qd;
      t.qdd.row(k) = qdd;
      t.tau.row(k) = Torque(q, qd, qdd);
    }
    t.standstill.setConstant(n, false);
    t.first_index = first_index;
    t.core_end = n;
    return t;
  }
};

}  // namespace armcal
