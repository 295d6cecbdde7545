#pragma once

#include <optional>

#include "calib/closed_loop/output_error.h"
#include "calib/linear/calibration.h"
#include "calib/logs/drawn_torques.h"
#include "calib/poses/calibration.h"
#include "calib/refine/nonlinear_calibration.h"

namespace armcal {

// What a calibration is made of: of torques, of poses alone, or of commands.
struct CalibrationDetails {
  std::optional<LinearCalibration> linear;
  std::optional<NonlinearCalibration> refined;
  std::optional<PoseCalibration> poses;
  std::optional<OutputErrorCalibration> commanded;
  std::optional<TracedModel> model;  // that predicts torques
  DrawnTorques torques;              // where they are drawn
};

}  // namespace armcal
