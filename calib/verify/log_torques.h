#pragma once

#include <string>
#include <vector>

#include "calib/logs/prepared_logs.h"
#include "calib/numerics/undefined.h"
#include "calib/refine/calibration_reader.h"
#include "model/robot/robot.h"

namespace armcal {

// A joint's torque over samples of logs, rms, N m or N. The residuals are those
// of recorded minus predicted torque, NaN where Simbody refuses the robot.
struct JointLogTorque {
  std::string name, unit;
  double recorded_rms = kNaN;
  double before_rms = kNaN;  // the robot file
  double after_rms = kNaN;   // the calibrated robot; NaN: there is none
};

// The torque of logs by Simbody's inverse dynamics of the links, with the
// joints' friction, offset and armature.
struct LogTorques {
  int samples = 0;
  std::vector<JointLogTorque> joints;
  // How far from it the robot's torque is as armcal calibrates it (regressor
  // times parameters) at most, relative: of the calibrated robot, else of the
  // file's. In 2-norm; a torque counts as at least 1e-3 of the largest. NaN
  // where Simbody refuses that robot.
  double max_rel = kNaN;

  // That at most. Model parameters take a column for a combination of others
  // where it is one to 1e-8 (ColumnBasis): angles that a file has to ten digits
  // make such columns, up to ten for each joint.
  static constexpr double kMostRel = 1e-7;
};

// At up to 20 000 samples of the logs, evenly spread. `calibrated` may be null.
LogTorques CompareLogTorques(const Robot& file,
                             const CalibratedRobot* calibrated,
                             const Progress& progress,
                             const PreparedLogs& logs);

}  // namespace armcal
