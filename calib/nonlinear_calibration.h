#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calib/linear_calibration.h"
#include "calib/log_set.h"
#include "calib/torque_residual.h"
#include "model/robot.h"

namespace armcal {

struct NonlinearCalibrationOptions {
  // Relative standard deviation of the robot file's inertial parameters, in
  // every direction of the links' pseudo-inertias. It ties what the logs do not
  // see.
  double trust = 0.5;
  Progress progress;
};

// One parameter of the robot that a simulator needs.
struct PhysicalParameter {
  std::string name;  // "<link>.mass", "<joint>.viscous"
  std::string unit;
  double value;
  double stddev;  // infinite where the logs do not determine it
  double prior;   // the robot file's value
  bool identifiable;
  bool held;  // not estimated: one with another parameter
};

// A robot with physically consistent links that moves like the logged one.
struct NonlinearCalibration {
  bool solved = false;
  std::string reason;
  int iterations = 0;
  Robot robot;  // with the estimated inertial parameters and joint terms
  std::vector<PhysicalParameter> parameters;
  Eigen::MatrixXd covariance;  // of them, prior included
  std::optional<TorqueResidual> training;
  std::optional<TorqueResidual> validation;
};

// Estimates links' inertial parameters (log-Cholesky, hence physically
// consistent) and joint terms from the torque equations of the logs, weighted
// as the linear calibration found them, with the robot file as prior.
NonlinearCalibration CalibrateNonlinear(
    const Robot& robot, const LinearCalibration& linear,
    const NonlinearCalibrationOptions& options, LogSet* training,
    LogSet* validation);

}  // namespace armcal
