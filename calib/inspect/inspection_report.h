#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calib/inspect/inspection.h"

namespace armcal {

// Text and JSON of what was found in a robot file and in logs.
std::string FullReport(const Robot& robot,
                       const std::vector<InspectionFinding>& of_robot,
                       const std::vector<LogInspection>& logs);
nlohmann::json ToJson(const Robot& robot,
                      const std::vector<InspectionFinding>& of_robot,
                      const std::vector<LogInspection>& logs);

}  // namespace armcal
