#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "calib/drive_trains/drive_train.h"

namespace armcal {

// `drive_trains` of calibration.json.
nlohmann::json DriveTrainsJson(const DriveTrains& drives);
// A row per joint; empty where no log has currents beside torques.
std::string DriveTrainsText(const DriveTrains& drives);

}  // namespace armcal
