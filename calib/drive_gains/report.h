#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "calib/drive_gains/drive_gains.h"

namespace armcal {

// On a terminal: each joint's gain or why there is none, the payload, and what
// error of the torque follows: `given_stddev`, where that was asked for.
std::string DriveGainsReport(const DriveGains& result,
                             std::optional<double> given_stddev = {});

// Sets `drive_gains[]` and `payload` of calibration.json. Where the gains are
// not all known there is nothing else to calibrate: `termination` says why.
void AddDriveGains(const DriveGains& result, nlohmann::json* calibration);

}  // namespace armcal
