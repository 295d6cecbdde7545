#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calib/linear_calibration.h"
#include "calib/pose_calibration.h"
#include "model/robot.h"

namespace armcal {

// Sentences that say why a calibration that ran does not give what was asked
// for: it has no solution, nothing can be seen from such data, a joint never
// moves, or the model does not explain what was measured. Directions that are
// not excited although all joints move are no reason: they are named, and the
// others hold. None where all is well.
std::vector<std::string> Shortcomings(const Robot& robot,
                                      const LinearCalibration& result);
std::vector<std::string> Shortcomings(const Robot& robot,
                                      const PoseCalibration& result);

// {passed, reasons[]}.
nlohmann::json VerdictJson(const std::vector<std::string>& shortcomings);

// One line for each, for a terminal.
std::string VerdictText(const std::vector<std::string>& shortcomings);

}  // namespace armcal
