#pragma once

#include "calib/poses/calibration.h"
#include "calib/poses/fit.h"
#include "calib/poses/pose_solution.h"

namespace armcal {

// How well poses are predicted that a fit has not seen: of every fold, by the
// estimate and by the file's geometry, and those of options.validation. Sets
// the figures of *result, whose outliers are known.
void ReportHeldOut(const PoseFit& fit, const PoseSolution& solution,
                   const PoseCalibrationOptions& options,
                   PoseCalibration* result);

}  // namespace armcal
