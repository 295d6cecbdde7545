#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "calib/fleet/calibration.h"
#include "calib/linear/calibration.h"
#include "model/robot/robot.h"

namespace armcal {

// What the fleet shares, how its units spread, which are out of the ordinary
// and why, what drifts.
std::string FleetText(const Robot& robot, const LinearCalibration& pooled,
                      const FleetCalibration& fleet,
                      const FleetOptions& options);
// fleet.json.
nlohmann::json ToJson(const Robot& robot, const LinearCalibration& pooled,
                      const FleetCalibration& fleet,
                      const FleetOptions& options);

}  // namespace armcal
