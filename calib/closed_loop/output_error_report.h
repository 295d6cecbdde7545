#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calib/closed_loop/output_error.h"

namespace armcal {

// Sentences that say why a calibration from commands does not give what was
// asked for; none where all is well.
std::vector<std::string> Shortcomings(const OutputErrorCalibration& result);

// Positions before and after, what was estimated beside the file's values, and
// what the data do not tell, for a terminal.
std::string OutputErrorReport(const Robot& robot,
                              const OutputErrorCalibration& result);

// calibration.json: residuals of joints are positions'.
nlohmann::json OutputErrorJson(const Robot& robot,
                               const std::vector<CommandedLog>& training,
                               const std::vector<CommandedLog>& validation,
                               const OutputErrorCalibration& result);

}  // namespace armcal
