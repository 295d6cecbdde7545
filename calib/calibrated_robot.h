#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "calib/calibrate_options.h"
#include "calib/calibrate_summary.h"
#include "calib/refine/nonlinear_calibration.h"
#include "model/dynamics/joint_controller.h"

namespace armcal {

// Adds a calibrated robot's files and the covariance of its parameters, and
// says in the report what the files lose. `controller`: what moves it where
// commands are positions.
void AddCalibratedRobot(const NonlinearCalibration& refined,
                        const std::optional<ControllerOptions>& controller,
                        const CalibrateOptions& options, nlohmann::json* json,
                        CalibrateSummary* summary);

// Sets parameters and covariance to those of the refined robot.
void SetParameters(const NonlinearCalibration& refined,
                   CalibrateSummary* summary);

}  // namespace armcal
