#pragma once

#include "calib/poses/calibration.h"
#include "model/log_files/pose_reader.h"
#include "model/robot/robot.h"

namespace armcal {

// Estimates the frame of the instrument, what it looks at, and the arm's
// geometry. A problem that cannot be solved is a result.
PoseCalibration CalibratePoses(const Robot& robot,
                               const PoseMeasurements& measured,
                               const PoseCalibrationOptions& options);

}  // namespace armcal
