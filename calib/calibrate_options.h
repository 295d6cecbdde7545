#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calib/linear/options.h"
#include "calib/log_input.h"
#include "calib/refine/arm_trust.h"
#include "calib/robot_source.h"
#include "model/log_files/log_reader_options.h"
#include "model/log_files/pose_reader.h"
#include "model/robot/arm_geometry.h"
#include "model/text/progress.h"

namespace armcal {

// What a calibration estimates.
enum class CalibrationTarget {
  kAuto,     // as kRefined where the robot has masses to start from
  kRefined,  // model parameters and a physically consistent robot
  kLinear    // model parameters alone
};

// Logs of the arm with a payload of known mass, which tell the torque constants
// of its drives from currents.
struct PayloadLogs {
  double mass = 0;  // kg
  std::vector<LogSource> logs;
};

// Logs with commands and positions, and none of torques (output error).
struct CommandedCalibrationOptions {
  std::string controller;    // path of the drives' law (docs/simulate.md)
  double gains_trust = 0;    // relative standard deviation of gains; 0: exact
  double delay_trust = .02;  // s, of the command's delay; 0: exact
  // Logs with torques of the same arm: one estimate is made of both.
  std::vector<LogSource> torque_logs;
};

struct CalibrateOptions {
  // Which equations of the logs, in which unknowns, and how they are solved.
  // Their loss, where given, is also that of poses, else Tukey's.
  LinearCalibrationOptions equations;
  CalibrationTarget target = CalibrationTarget::kAuto;
  // Which of the robot's own geometry is estimated as well.
  RefineGeometry geometry = RefineGeometry::kNothing;
  ArmTrust trust;                         // in the robot file
  std::optional<PoseMeasurements> poses;  // without logs: the geometry alone
  // Maximum likelihood, with splines through all motions, for noisy encoders.
  bool correct_trajectories = false;
  // Calibrates on the segments of this length, s, that tell most.
  std::optional<double> select_s;
  // How the torques of logs are read; joint_names are the robot's.
  LogReaderOptions reading;
  LogInput validation;  // held out, to check the result
  // The same of poses without logs: of the same instrument, which has not been
  // moved, and what it looked at.
  std::optional<PoseMeasurements> pose_validation;
  std::optional<PayloadLogs> payload;
  std::optional<CommandedCalibrationOptions> commands;
  std::vector<std::string> exports;  // formats beside URDF: "mjcf", "sdf" ..
  int samples = 0;                   // robots to draw from the posterior
  RobotSource source;                // of the robot
  bool draw_torques = false;         // for report.html, in `details`
  Progress progress;
};

}  // namespace armcal
