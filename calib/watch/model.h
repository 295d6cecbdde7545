#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/dynamics/model_parameters.h"
#include "model/robot/robot.h"

namespace armcal {

// A calibrated robot as the torque equations tau = U x know it.
struct WatchModel {
  Robot robot;  // calibrated
  ModelParameters parameters;
  Eigen::VectorXd x;           // the parameters' calibrated values
  Eigen::MatrixXd covariance;  // of their errors: the calibration's posterior
  // Per joint, N m or N: what the calibration left of the low-passed torque,
  // and the torque itself, root mean squares.
  Eigen::VectorXd residual_rms, torque_rms;

  int num_joints() const { return robot.num_joints(); }
  int size() const { return static_cast<int>(x.size()); }
};

// Of the calibration.json (or the folder that has it) that `armcal calibrate`
// wrote for this robot file, and of the posterior beside it. Throws InputError
// as ReadCalibration and ReadParameterPosterior do.
WatchModel ReadWatchModel(const Robot& nominal, const std::string& path);

// The change of the parameters x per unit of each of the last link's ten
// inertial parameters: what a body that is fixed to it, or taken from it, adds.
Eigen::MatrixXd PayloadColumns(const WatchModel& model);

// Which of the parameters x is this term of joint j; -1: none is that alone.
int TermColumn(const ModelParameters& parameters, int j, JointTerm term);

}  // namespace armcal
