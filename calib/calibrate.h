#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calib/linear/options.h"
#include "calib/log_input.h"
#include "calib/refine/arm_trust.h"
#include "calib/robot_source.h"
#include "calib/summary.h"
#include "model/log_files/log_reader_options.h"
#include "model/log_files/pose_reader.h"
#include "model/robot/arm_geometry.h"
#include "model/robot/robot.h"
#include "model/text/progress.h"

namespace armcal {

struct CalibrationDetails;  // calib/calibration_details.h

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
  std::string controller;   // path of the drives' law (docs/simulate.md)
  double gains_trust = 0;   // relative standard deviation of gains; 0: exact
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
  std::optional<PayloadLogs> payload;
  std::optional<CommandedCalibrationOptions> commands;
  std::vector<std::string> exports;  // formats beside URDF: "mjcf", "sdf" ..
  RobotSource source;                // of the robot
  bool draw_torques = false;         // for report.html, in `details`
  Progress progress;
};

struct EstimatedParameter {
  std::string name;
  std::string unit;
  double value;
  double stddev;  // infinite where the data do not tell it
};

struct CalibrateSummary : Summary {
  bool solved = false;
  // Of the robot for simulators where it was refined, else of the model; their
  // covariance has rows of zeros where the data do not tell.
  std::vector<EstimatedParameter> parameters;
  Eigen::MatrixXd covariance;
  std::optional<Robot> robot;  // calibrated, for simulators
  std::shared_ptr<const CalibrationDetails> details;
};

// Calibrates a robot from logs of positions and torques, or from commands and
// positions with `options.commands`, or from poses alone where there are no
// logs. Throws InputError for what files and arrays hold, OptionError for
// options that do not go together. What cannot be solved is a result.
CalibrateSummary Calibrate(const Robot& robot, const LogInput& logs,
                           const CalibrateOptions& options);

}  // namespace armcal
