#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/closed_loop/position_trace.h"
#include "calib/closed_loop/replay.h"
#include "calib/closed_loop/torque_information.h"
#include "calib/closed_loop/unknowns.h"
#include "calib/closed_loop/values.h"
#include "calib/logs/log_set.h"
#include "calib/refine/nonlinear_calibration.h"
#include "model/dynamics/joint_controller.h"
#include "model/dynamics/joint_term.h"
#include "model/robot/robot.h"

namespace armcal {

struct OutputErrorOptions {
  LoopTrust trust;
  std::vector<JointTerm> joint_terms = {JointTerm::kViscous,
                                        JointTerm::kCoulomb, JointTerm::kOffset,
                                        JointTerm::kArmature};
  double coulomb_width = .02;  // rad/s or m/s, to start with
  // Logs are simulated in windows, each from a state of its own, side by side:
  // a loop forgets within a fraction of a second where it began.
  double window_s = 4;
  // Above 0: positions of the held-out logs, or of all if there are none, are
  // kept for drawing in at most so many bins.
  int trace_bins = 0;
  Progress progress;
};

// Root mean squares of simulated minus measured positions, rad or m, without
// the first second of windows, per joint.
struct PositionFigures {
  Eigen::VectorXd noise;    // of the encoders, standard deviation
  Eigen::VectorXd nominal;  // of the robot file
  Eigen::VectorXd calibrated;
  Eigen::VectorXd validation;  // of held-out logs; empty: there are none
  Eigen::VectorXd nominal_validation;  // the same of the robot file
};

struct OutputErrorCalibration {
  // Its figures of torques are not set.
  NonlinearCalibration arm;
  LoopValues values;
  PositionFigures positions;
  // Of residuals over what encoder noise alone makes of them: 1 where the model
  // is right. Deviations are this many times wider.
  double model_error = 1;
  // Simulated with the file's values and with the estimate.
  std::vector<PositionTrace> traces;
};

// Estimates an arm and its controller from commanded and measured positions
// alone: simulated in closed loop, the arm shall be where it was measured
// (output error). Gauss-Newton with exact derivatives of the simulation. The
// controller knows the robot file. `torques`: what other logs, with torques, of
// the same arm say (null: none); one estimate is made of both.
OutputErrorCalibration CalibrateOutputError(
    const Robot& robot, const ControllerOptions& controller,
    const OutputErrorOptions& options,
    const std::vector<CommandedLog>& training,
    const std::vector<CommandedLog>& validation,
    const TorqueInformation* torques = nullptr);

}  // namespace armcal
