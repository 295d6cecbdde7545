#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "calib/logs/wiring.h"
#include "model/robot/robot.h"

namespace armcal {

// How many times the torque that the robot file's links need is in the recorded
// one, per joint, friction, armature and an offset apart. NaN where they need
// hardly any or the two are not alike (partial correlation below 0.7).
//
//   tau_j = s_j x_j(q, qd, qdd) + (viscous, Coulomb, armature, offset) + e,
//
// x_j by the file's inertial parameters. s_j is 1 for a file that is right and
// a torque in N m; wrong masses change it as far as they are wrong. It is the
// robust slope of what is left of tau_j over what is left of x_j after both
// were freed of the other four.
struct TorqueScales {
  Eigen::VectorXd scale;
  // Its 95 % interval, from slopes that leave out an eighth of the samples each
  // (jackknife of stretches: samples that follow each other err alike).
  Eigen::VectorXd low, high;
  // x_j and tau_j freed of the other terms, N m or N, samples x n.
  Eigen::MatrixXd needed, recorded;
  std::vector<bool> asked;  // of joints that move and need a torque

  bool told(int joint) const {
    return scale.size() > joint && std::isfinite(scale[joint]);
  }
  // Of all joints that are driven and need a torque, told or not: the median of
  // rms recorded over rms needed, which no wrong sign changes. 0: of none.
  double Size() const;
  // Whether the torques of all joints that are told, two at least, are opposite
  // to what the file's links need.
  bool AreOpposite() const;
  // Rms that needed leaves of recorded / unit, over the rms of recorded / unit.
  double Left(int joint, double unit) const;
};

// No file's inertias are off by that factor, in all links at once, nor does a
// load multiply the torques of all joints by it.
constexpr double kNotInertia = 4;

TorqueScales TorqueScale(const Robot& robot, const WiringSamples& samples);

}  // namespace armcal
