#pragma once

#include <Eigen/Core>

#include "calib/linear/calibration.h"
#include "model/dynamics/model_parameters.h"
#include "model/robot/robot.h"

namespace armcal {

// What information about model parameters is measured by, after a calibration
// of logs.
struct InformationScale {
  // `linear` is of `robot` with `options`.
  InformationScale(const Robot& robot, const LinearCalibration& linear,
                   const LinearCalibrationOptions& options);

  // `information` (m x m) in units in which a standard deviation of 1 is as
  // much as a joint's torque.
  Eigen::MatrixXd Scaled(const Eigen::MatrixXd& information) const {
    return unit.asDiagonal() * information * unit.asDiagonal();
  }
  // How many directions have a standard deviation below 1.
  int Rank(const Eigen::MatrixXd& information) const;

  // The parameters of `linear`, with Coulomb friction that changes sign within
  // a speed, which joints that hardly move need.
  ModelParameters model;
  Eigen::VectorXd density;  // ErrorDensity, above 0 for every joint
  Eigen::VectorXd unit;     // per parameter
};

}  // namespace armcal
