#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "calib/poses/calibration.h"
#include "model/log_files/pose_reader.h"
#include "model/robot/robot.h"

namespace armcal {

// What a person needs of a geometric calibration on a terminal.
std::string PoseReport(const Robot& robot, const PoseMeasurements& measured,
                       const PoseCalibration& result);

// calibration.json of a geometric calibration: geometry[], poses, termination.
nlohmann::json PoseJson(const Robot& robot, const PoseMeasurements& measured,
                        const PoseCalibration& result);

}  // namespace armcal
