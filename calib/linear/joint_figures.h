#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "calib/logs/torque_residual.h"

namespace armcal {

// Sets one joint's residual figures in its entry of `joints`, each key after
// `prefix` ("" or "validation_").
void SetJointFigures(const TorqueResidual& residual, const std::string& prefix,
                     int joint, nlohmann::json* entry);

}  // namespace armcal
