#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "calib/force_torque/sensor.h"

namespace armcal {

// `force_torque_sensor` of calibration.json (docs/calibrate.md).
nlohmann::json ForceTorqueJson(const ForceTorqueSensor& sensor);

// Two or three lines for people, and one for each thing that is not told; empty
// where no log has the columns.
std::string ForceTorqueText(const ForceTorqueSensor& sensor);

}  // namespace armcal
