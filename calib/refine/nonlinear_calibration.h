#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calib/linear/calibration.h"
#include "calib/logs/log_set.h"
#include "calib/logs/torque_residual.h"
#include "calib/refine/arm_unknowns.h"
#include "model/log_files/pose_reader.h"
#include "model/robot/robot.h"
#include "problems/poses/pose_problem.h"

namespace armcal {

struct NonlinearCalibrationOptions {
  // How far the robot file's values may be from the truth. It ties what
  // the data do not see.
  ArmTrust trust;
  RefineGeometry refine = RefineGeometry::kNothing;
  RobustLoss pose_loss = RobustLoss::kTukey;
  Progress progress;
};

// One parameter of the robot that a simulator needs.
struct PhysicalParameter {
  std::string name;  // "<link>.mass", "<joint>.viscous", "<link>.a"
  std::string unit;
  double value;
  double stddev;  // infinite where the data do not determine it
  double prior;   // the robot file's value
  bool identifiable;
  bool held;              // not estimated: one with another parameter
  bool geometry;          // of the arm, its base, tool, instrument or targets
  bool at_bound = false;  // friction or armature that would be negative
};

// Measured poses at an estimate.
struct PoseFigures {
  double rms = 0;  // m, distances per target or pose
  double max = 0;
  double before_rms = 0;              // only the instrument's frame fitted
  std::vector<double> before, after;  // the distances, m
  PoseNoise noise;
};

// A robot with physically consistent links that moves like the real one.
struct NonlinearCalibration {
  bool solved = false;
  std::string reason;  // Ceres' word, or why it is not solved
  bool converged() const { return solved && reason == "CONVERGENCE"; }
  int iterations = 0;
  Robot robot;    // with the estimated parameters
  Robot nominal;  // as the file has it, but for recovered lengths
  std::vector<PhysicalParameter> parameters;
  Eigen::MatrixXd covariance;  // of them, prior included
  // Combinations that the data do not tell: only the file's values do.
  std::vector<std::string> unseen;
  std::optional<TorqueResidual> training;
  std::optional<TorqueResidual> validation;
  std::optional<PoseFigures> poses;
  // Of the linear calibration: robot has them, taken for exact.
  std::vector<RecoveredLength> lengths;
  bool refined_geometry = false;  // or the tool: robot's is not the file's
};

// Estimates links' inertial parameters (log-Cholesky, hence physically
// consistent), joint terms and, where asked for, the geometry from the torque
// equations of the logs, weighted as the linear calibration found them, and
// from measured poses, if any (null: none), with the robot file as prior. Where
// the linear calibration recovered lengths, the arm has these.
NonlinearCalibration CalibrateNonlinear(
    const Robot& robot, const LinearCalibration& linear,
    const NonlinearCalibrationOptions& options, const LogSet& training,
    const LogSet* validation, const PoseMeasurements* poses = nullptr);

}  // namespace armcal
