#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "calib/fleet/reduction.h"
#include "calib/linear/calibration.h"
#include "model/robot/robot.h"

namespace armcal {

// A log as it was reduced: where it goes, rows, model.
std::string ReductionText(const Robot& robot, const Reduction& reduction);
nlohmann::json ToJson(const Reduction& reduction);

// What factors say together: calibration.json, as `calibrate` has its keys, and
// the text of it.
std::string FullReport(const Robot& robot, const Reduction& reduction,
                       const LinearCalibration& result);
std::string BriefReport(const Robot& robot, const Reduction& reduction,
                        const LinearCalibration& result);
nlohmann::json ToJson(const Robot& robot, const Reduction& reduction,
                      const LinearCalibration& result);

}  // namespace armcal
