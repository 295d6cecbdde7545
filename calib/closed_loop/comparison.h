#pragma once

#include <string>
#include <vector>

#include "calib/closed_loop/replay.h"
#include "calib/refine/calibration_reader.h"
#include "model/dynamics/joint_controller.h"
#include "model/robot/robot.h"

namespace armcal {

// One joint of a closed loop that follows the logged command.
struct ClosedLoopJoint {
  std::string name;
  std::string unit;   // "rad" or "m"
  double before_rms;  // of simulated minus recorded positions
  double after_rms;   // NaN without a calibration
  // N m or N, of controller minus recorded torque; NaN where none is recorded.
  double before_torque_rms;
  double after_torque_rms;
  double torque_rms;  // of the recorded torque
};

struct ClosedLoopComparison {
  bool before_finite = true;  // the simulated loop is stable
  bool after_finite = true;   // the file's where there is no calibration
  std::vector<ClosedLoopJoint> joints;
};

// Lets the controller move the robot file's robot and, unless null, the
// calibrated one along the command of the log (calib/closed_loop/replay.h). The
// controller knows the robot file.
ClosedLoopComparison CompareClosedLoop(const Robot& file,
                                       const CalibratedRobot* calibrated,
                                       const ControllerOptions& controller,
                                       const CommandedLog& log);

}  // namespace armcal
