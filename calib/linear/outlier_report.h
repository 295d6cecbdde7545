#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "calib/linear/calibration.h"
#include "calib/logs/log_set.h"
#include "model/robot/robot.h"

namespace armcal {

// Torque samples of the training logs that the calibration left out.
long CountOutliers(const LinearCalibration& result);
long CountOutliers(const LinearCalibration& result, int joint);

// One line for a terminal; empty where there are none.
std::string OutlierText(const Robot& robot, const LinearCalibration& result);

// {log, row, time, joint, value, residual} of each, at most the first `most`;
// the residual in noise deviations.
nlohmann::json OutlierJson(const Robot& robot, const LogSet& training,
                           const LinearCalibration& result, int most);

// outliers.csv: the same of all of them, under a header that is always there,
// so that no older list stands beside a clean log.
std::string OutlierCsv(const Robot& robot, const LogSet& training,
                       const LinearCalibration& result);

}  // namespace armcal
