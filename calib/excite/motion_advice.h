#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/linear/calibration.h"
#include "calib/logs/log_set.h"
#include "model/robot/robot.h"

namespace armcal {

// What to move so that the directions show that `linear` could not see in
// `logs`: joints alone, in pairs or all, about the logs' mean posture and
// within the robot's limits; the one first that shows most, of equals the one
// with fewer joints. Empty where nothing is missing or no motion helps.
std::vector<AdvisedMotion> AdviseMotions(
    const Robot& robot, const LinearCalibration& linear,
    const LinearCalibrationOptions& options, const LogSet& logs);

}  // namespace armcal
