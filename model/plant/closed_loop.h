#pragma once

#include <Eigen/Core>
#include <functional>

#include "model/dynamics/joint_controller.h"
#include "model/dynamics/simulated_robot.h"
#include "model/log_files/log.h"
#include "model/plant/arm_simulator.h"
#include "model/plant/reference_motion.h"
#include "model/plant/sensors.h"

namespace armcal {

struct ClosedLoopOptions {
  ControllerOptions controller;
  SensorOptions sensors;
  double step = 1e-3;  // s, of ArmSimulator; at most the control period
  // How long the loop holds the first position before the log begins, s.
  double settle = 1;
  std::function<void(double share)> progress;  // may be empty
};

struct ClosedLoopRun {
  // Of the driven joints: stamps, measured q, the controller's qd, torque as
  // recorded, qref and temperature.
  Log log;
  // Where the driven joints' links truly were at the log's samples, rad or m,
  // samples x n; empty where all move with their motors.
  Eigen::MatrixXd link_position;
  bool finite = true;          // false: it diverged, and the log ends there
  double saturated_share = 0;  // of control periods, some torque at its limit
  // Root mean square of qref - q, n entries, rad or m; NaN where the log has
  // no row.
  Eigen::VectorXd tracking_rms;
  double tracking_peak = 0;  // rad or m, the largest of any joint
};

// Whether the log's rate divides the controller's.
bool LogRateFits(const ClosedLoopOptions& options);

// Lets a controller, which knows `model`, move the simulated robot along a
// motion and keeps the log. `dynamics` is of robot.robot. Throws InputError
// where the log's rate does not fit.
ClosedLoopRun RunClosedLoop(const SimulatedRobot& robot, const Robot& model,
                            const ReferenceMotion& motion,
                            const ClosedLoopOptions& options,
                            ArmDynamics* dynamics);

}  // namespace armcal
