#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "calib/drive_gains/drive_gains.h"

namespace armcal {

// On a terminal: each joint's gain or why there is none, and the payload.
std::string DriveGainsReport(const DriveGains& result);

// Sets `drive_gains[]` and `payload` of calibration.json. Where the gains are
// not all known there is nothing else to calibrate: `termination` says why.
void AddDriveGains(const DriveGains& result, nlohmann::json* calibration);

}  // namespace armcal
