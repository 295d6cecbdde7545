#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "calib/calibrate_options.h"
#include "calib/calibrate_summary.h"
#include "calib/calibration_details.h"
#include "calib/diagnose/data/audit.h"
#include "calib/log_input.h"
#include "calib/logs/log_set.h"
#include "model/robot/robot.h"

namespace armcal {

// Puts findings before all else that report, brief and `warnings` of a
// calibration say.
void TellFirst(const std::vector<DataFinding>& found, nlohmann::json* json,
               CalibrateSummary* summary);

// Asks the logs of a calibration for readings that are wrong (WrongReadings),
// and tells them first. A linear fit does not notice them: torques that are
// negated, or a thousand times as large, fit it with parameters that are
// negated or a thousand times as large.
//
// Asking takes as long as half a calibration. So it is done where the figures
// leave room for it, and not where the robot that was found explains all
// joints' torques to what an arm leaves that is read rightly, with masses of
// the file's size; where no robot was found, always. Asked are the first rows
// of at most four logs, from the first to the last: one recorder writes all
// logs of a robot alike, and what is looked for shows in seconds of motion.
//
// What was mended of the logs before (MendPositions) is told in any case, first
// of all.
//
// Of a file without masses, or with lengths that are to be estimated, only time
// is asked for its unit.
void AddLogDoubts(const Robot& robot, const LogInput& logs,
                  const CalibrateOptions& options,
                  const std::vector<DataFinding>& mended,
                  const LogSet& training, const CalibrationDetails& details,
                  nlohmann::json* json, CalibrateSummary* summary);

}  // namespace armcal
