#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/robot/robot.h"
#include "tools/command.h"
#include "tools/output_folder.h"
#include "tools/report/report_page.h"

namespace armcal {

// Adds report.html to the results, where the input wants it: `result`, the
// command line, the robot at a bent posture, the hashes of the robot file and
// of `files`, and what `complete` (or null) knows besides.
void AddReport(const CommandInput& input, const std::string& command,
               const Robot& robot, const nlohmann::json& result,
               const std::vector<std::string>& files,
               const std::function<void(ReportContent*)>& complete,
               OutputFolder* out);

}  // namespace armcal
