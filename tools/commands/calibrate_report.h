#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "calib/linear/calibration.h"
#include "calib/logs/log_set.h"
#include "calib/refine/nonlinear_calibration.h"
#include "model/robot/robot.h"
#include "tools/command.h"
#include "tools/output_folder.h"

namespace armcal {

// What report.html shows of a calibration beside its JSON.
struct CalibrationDrawing {
  const LinearCalibration& linear;
  const NonlinearCalibration* refined;  // null: there is none
  PreparedLogs logs;                    // whose torques are drawn
};

void AddCalibrationReport(const CommandInput& input, const Robot& robot,
                          const std::string& json,
                          const CalibrationDrawing& drawing, OutputFolder* out);

// {skeleton, poses}: a calibrated geometry, and distances of poses before and
// after, m.
nlohmann::json GeometryDrawing(const Robot& calibrated,
                               const std::vector<double>& before,
                               const std::vector<double>& after);

}  // namespace armcal
