#pragma once

#include <nlohmann/json.hpp>

#include "calib/calibrate.h"
#include "calib/calibration_details.h"
#include "model/dynamics/joint_controller.h"

namespace armcal {

// The three calibrations of calibrate.h, by what was measured.
CalibrateSummary CalibrateFromTorques(const Robot& robot, const LogInput& logs,
                                      const CalibrateOptions& options);
CalibrateSummary CalibrateFromCommands(const Robot& robot, const LogInput& logs,
                                       const CalibrateOptions& options);
CalibrateSummary CalibrateFromPoses(const Robot& robot,
                                    const CalibrateOptions& options);

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
