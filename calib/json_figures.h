#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "calib/torque_residual.h"

namespace armcal {

// A number, or null where it is infinite or undefined: JSON has neither.
nlohmann::json JsonNumber(double x);

// Sets one joint's residual figures in its entry of `joints`, each key after
// `prefix` ("" or "validation_").
void SetJointFigures(const TorqueResidual& residual, const std::string& prefix,
                     int joint, nlohmann::json* entry);

}  // namespace armcal
