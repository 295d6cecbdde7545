#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calib/linear/identifiability.h"
#include "calib/linear/length_recovery.h"
#include "calib/linear/options.h"
#include "calib/linear/solution.h"
#include "calib/linear/used_equations.h"
#include "calib/logs/prepared_logs.h"
#include "calib/logs/sample_noise.h"
#include "calib/logs/torque_residual.h"
#include "model/dynamics/model_parameters.h"
#include "model/robot/robot.h"
#include "problems/identification_rows.h"
#include "problems/robust_loss.h"

namespace armcal {

// What a linear calibration found. Vectors have an entry per model parameter,
// or per joint where said.
struct LinearCalibration {
  explicit LinearCalibration(const ModelParameters& model);

  ModelParameters parameters;
  std::vector<CoulombTransition> transitions;  // per joint, if in the model
  bool fitted_transitions = false;

  bool solved = false;
  std::string reason;  // why it stopped, or why it refused
  int passes = 0;      // over the logs
  // Per joint, samples of its position that were left out as spikes
  // (position_spikes.h).
  Eigen::Array<long, 1, Eigen::Dynamic> position_spikes;
  Eigen::VectorXd x;
  Eigen::VectorXd stddev;  // infinite where not identifiable
  Eigen::MatrixXd covariance;
  // What it would be if the equations had independent errors.
  Eigen::MatrixXd independent_covariance;
  std::string covariance_method;
  // Of each joint's torque scale, relative, which is part of the covariance.
  double torque_constants_stddev = 0;
  Eigen::MatrixXd scale_covariance;  // which is what that makes of it
  // Of the covariance: rows per window of its scores, rows that overlap.
  int score_window = 1;
  int rows_per_window = 1;
  std::vector<bool> identifiable;
  Eigen::VectorXd noise;  // per joint, of the equations: N m, N (N m s, N s)
  std::vector<SampleNoise> sample_noise;  // per joint, if solved
  // Per joint, rad or m, where trajectories were corrected; else empty.
  Eigen::VectorXd encoder_noise;
  Identifiability identifiability;
  std::vector<RecoveredLength> lengths;

  LinearSolver solver = LinearSolver::kWeighted;
  RobustLoss loss = RobustLoss::kSquared;  // that was used
  std::vector<JointTerm> joint_terms;      // asked for, merged or not
  RowOptions rows;
  // What the result is of: the training logs prepared like this, without the
  // torque samples that proved to be gross errors.
  PreparationOptions preparation;
  std::optional<FrictionBand> friction;  // PreparedLogs::friction
  EquationMask used;                     // [log][joint]
  // Standard deviations over those of independent rows, median.
  double inflation = 1;
  long equations = 0;
  std::vector<long> outliers;  // per joint: equations Huber weighs below 1/2
  std::vector<UnpoweredJoint> unpowered;
  Eigen::VectorXd travel;            // per joint, rad or m
  Eigen::ArrayXd mean_square_speed;  // per joint, (rad/s)^2 or (m/s)^2
  std::optional<TorqueResidual> training;
  std::optional<TorqueResidual> validation;
};

}  // namespace armcal
