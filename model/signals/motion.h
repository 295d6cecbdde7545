#pragma once

#include <Eigen/Core>

namespace armcal {

// A torque as it was recorded, N m or N, low-passed at hz; empty: it was not.
struct SmoothTorque {
  Eigen::MatrixXd tau;
  double hz = 0;

  SmoothTorque OfJoint(int j) const {
    return {tau.size() > 0 ? tau.col(j) : tau, hz};
  }
};

// Motion of an arm at equally spaced instants, samples in rows, joints in
// columns in the robot's order.
struct Motion {
  double t0 = 0;                // s, of row 0
  double dt = 0;                // s
  Eigen::MatrixXd q;            // rad or m
  Eigen::MatrixXd qd;           // rad/s or m/s
  Eigen::MatrixXd qdd;          // rad/s^2 or m/s^2
  Eigen::MatrixXd temperature;  // deg C; empty: not recorded
  // At which friction is the robot's, deg C; empty: that of row 0.
  Eigen::VectorXd usual_temperature;
  // How far stamps are from even ones, s (TimeBase); empty: they are even.
  Eigen::VectorXd stamp_error;
  // As the controller recorded it. Wanted where what is asked for says more
  // than what is given: at a limit, and where it comes late.
  SmoothTorque torque;
  // Of torques that were reconstructed from these positions: what they grow by
  // per unit of rate of the stamps' clock beyond time, N m or N; empty: they
  // were recorded.
  Eigen::MatrixXd torque_by_rate;

  int size() const { return static_cast<int>(q.rows()); }
  int num_joints() const { return static_cast<int>(q.cols()); }
  double time(int row) const { return t0 + row * dt; }
};

}  // namespace armcal
