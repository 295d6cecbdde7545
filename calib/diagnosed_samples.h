#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calib/diagnose/diagnosis.h"
#include "calib/robot_source.h"
#include "calib/summary.h"
#include "model/robot_files/robot_format.h"

namespace armcal {

// Adds the robots that a diagnosis of `robot` drew to a result's files, each
// with its effects and in these formats, and says so in `json`; or there why
// there are none. Returns the line of a report, none where none was asked for.
std::string AddDiagnosedSamples(const Robot& robot,
                                const GapDiagnosis& diagnosis,
                                const RobotSource& source,
                                const std::vector<const RobotFormat*>& formats,
                                nlohmann::json* json,
                                std::vector<ResultFile>* results);

}  // namespace armcal
