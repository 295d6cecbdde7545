#pragma once

#include <Eigen/Core>
#include <string>

namespace armcal {

// A stretch of a recorded log in SI units, samples in rows, joints in columns
// in the robot's order. Matrices of signals that were not asked for or that the
// log lacks are empty (0 x 0).
struct Log {
  Eigen::VectorXd t;            // s since the log's first row, never falling
  Eigen::MatrixXd q;            // rad or m
  Eigen::MatrixXd qd;           // rad/s or m/s
  Eigen::MatrixXd qdd;          // rad/s^2 or m/s^2
  Eigen::MatrixXd tau;          // N m or N, on the joint side
  Eigen::MatrixXd qref;         // rad or m, what the controller was to follow
  Eigen::MatrixXd temperature;  // deg C, of the joints
  // Of a force-torque sensor, in its own axes, 6 columns: fx, fy, fz (N), tx,
  // ty, tz (N m).
  Eigen::MatrixXd wrench;
  // Of the motors, A, where the joints have torque sensors as well.
  Eigen::MatrixXd current;
  bool simulated = false;  // the log says that a simulation has written it
  long first_row = 0;      // the first sample's line in the file, header = 1

  int size() const { return static_cast<int>(t.size()); }
};

}  // namespace armcal
