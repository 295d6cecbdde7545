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
  // Columns of what is estimated: the parameters, then per joint the sizes of
  // kSlowLaws terms by which friction at low speed may be another than viscous
  // and Coulomb friction (causal_rows.h), N m or N.
  static constexpr int kSlowLaws = 2;
  int columns() const { return size() + kSlowLaws * num_joints(); }
};

// Of the calibration.json (or the folder that has it) that `armcal calibrate`
// wrote for this robot file, and of the posterior beside it. Throws InputError
// as ReadCalibration and ReadParameterPosterior do.
WatchModel ReadWatchModel(const Robot& nominal, const std::string& path);

// The change of the parameters x per unit of each of the last link's ten
// inertial parameters: what a body that is fixed to it, or taken from it, adds.
Eigen::MatrixXd PayloadColumns(const WatchModel& model);

// The calibration's errors as columns() know them, of mean 0. The terms of low
// speed are a tenth of the joint's Coulomb friction, a standard deviation:
// Stribeck's effect of lubricated gears is as large (Armstrong-Helouvry,
// Dupont, Canudas de Wit 1994).
Eigen::MatrixXd CovarianceWithSlowLaws(const WatchModel& model);

// Which of the parameters x is this term of joint j; -1: none is that alone.
int TermColumn(const ModelParameters& parameters, int j, JointTerm term);

}  // namespace armcal
