#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calib/calibration_reader.h"
#include "calib/rollout.h"
#include "model/log.h"
#include "model/log_reader.h"
#include "model/plant/joint_controller.h"
#include "model/robot.h"
#include "model/time_base.h"

namespace armcal {

// The rows of a log within `crop`, its times from 0: positions, torque and
// qref. Throws InputError where it has no qref columns, more than 2^20 rows or
// nothing is left.
Log ReadCommandedLog(const std::string& path, const LogReaderOptions& options,
                     const TimeRange& crop);

// One joint of a closed loop that follows the logged command.
struct ClosedLoopJoint {
  std::string name;
  std::string unit;          // "rad" or "m"
  double before_rms;         // of simulated minus recorded positions
  double after_rms;          // NaN without a calibration
  double before_torque_rms;  // N m or N, of controller minus recorded torque
  double after_torque_rms;
  double torque_rms;  // of the recorded torque
};

struct ClosedLoopComparison {
  bool before_finite = true;  // the simulated loop is stable
  bool after_finite = true;   // the file's where there is no calibration
  std::vector<ClosedLoopJoint> joints;
};

// Lets the controller move the robot file's robot and, unless null, the
// calibrated one along the command of the log (arm_engine.h). The controller
// knows the robot file. The first second, in which a log that does not begin at
// rest is caught up with, is not counted.
ClosedLoopComparison CompareClosedLoop(const Robot& file,
                                       const CalibratedRobot* calibrated,
                                       const ControllerOptions& controller,
                                       const std::string& path, const Log& log);

}  // namespace armcal
