#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/robot.h"
#include "tools/report/report_page.h"

namespace armcal {

// report.html of this run, but for what only the command itself knows: its
// command line, the robot at a bent posture, and the hashes of the robot file
// and of `files`.
ReportContent StartReport(const std::string& command, const Robot& robot,
                          const nlohmann::json& result,
                          const std::vector<std::string>& files);

}  // namespace armcal
