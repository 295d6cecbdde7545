#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "calib/logs/log_set.h"
#include "model/robot/robot.h"

namespace armcal {

// Torque samples of `logs` that are listed as outliers.
long CountOutliers(const LogSet& logs);
long CountOutliers(const LogSet& logs, int joint);

// One line for a terminal; empty where there are none.
std::string OutlierText(const Robot& robot, const LogSet& logs);

// {log, row, time, joint, value, residual} of each, at most the first `most`;
// the residual in noise deviations.
nlohmann::json OutlierJson(const Robot& robot, const LogSet& logs, int most);

// outliers.csv: the same of all of them, under a header that is always there,
// so that no older list stands beside a clean log.
std::string OutlierCsv(const Robot& robot, const LogSet& logs);

}  // namespace armcal
