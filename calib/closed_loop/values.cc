#include "calib/closed_loop/values.h"

#include <algorithm>
#include <cmath>

#include "model/dynamics/forward_dynamics.h"

namespace armcal {

using Eigen::VectorXd;

// Friction of slope b = viscous + coulomb / width stops a joint with the time
// constant 1 / ((M^-1)_jj b). Steps are to be a share of the fastest one that
// joints can have together; its rate, an eigenvalue of M^-1 diag(b), is at most
// the trace of that matrix, the sum over joints.
int EnoughSubsteps(const LoopValues& values, double rate_hz) {
  // Of the time constant with which friction alone stops a joint; and how much
  // faster it may be.
  constexpr double kOfTimeConstant = .7, kMoreFriction = 2;
  constexpr double kMost = 32;
  const Robot& robot = values.arm.robot;
  const int n = robot.num_joints();
  Eigen::MatrixXd M = MassMatrix(robot, VectorXd::Zero(n));
  for (int j = 0; j < n; ++j) M(j, j) += robot.links[j].joint.armature;
  double fastest = 0;
  for (int j = 0; j < n; ++j) {
    const Joint& joint = robot.links[j].joint;
    const double slope =
        joint.viscous + joint.coulomb / values.arm.transitions[j].width;
    const VectorXd unit = VectorXd::Unit(n, j);
    fastest += slope * SolveInertia(M, unit)[j];
  }
  const double wanted =
      std::ceil(kMoreFriction * fastest / (kOfTimeConstant * rate_hz));
  return static_cast<int>(std::clamp(wanted, 1., kMost));
}

const std::vector<double DriveLaw::*>& EstimatedGains() {
  static const std::vector<double DriveLaw::*> gains = {
      &DriveLaw::kp,          &DriveLaw::kd,
      &DriveLaw::ki,          &DriveLaw::position_gain,
      &DriveLaw::velocity_ki, &DriveLaw::lag};
  return gains;
}

}  // namespace armcal
