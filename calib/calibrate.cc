#include "calib/calibrate.h"

#include "calib/calibrate_parts.h"

namespace armcal {

CalibrateSummary Calibrate(const Robot& robot, const LogInput& logs,
                           const CalibrateOptions& options) {
  CalibrateOptions complete = options;
  complete.reading.joint_names = robot.JointNames();
  complete.equations.progress = options.progress;
  if (options.poses && logs.logs.empty()) {
    return CalibrateFromPoses(robot, complete);
  }
  return options.commands ? CalibrateFromCommands(robot, logs, complete)
                          : CalibrateFromTorques(robot, logs, complete);
}

}  // namespace armcal
