#pragma once

#include "calib/linear/calibration_model.h"
#include "calib/linear/identifiability.h"
#include "calib/linear/residual_pass.h"
#include "calib/linear/row_covariance.h"
#include "calib/linear/solution.h"

namespace armcal {

// The covariance of a solution from rows (EstimateRowCovariance), with the
// uncertainty of fitted widths of Coulomb friction, which friction and armature
// share, included.
CovarianceEstimate EstimateCovariance(
    const Robot& robot, const LinearCalibrationOptions& options,
    const RowOptions& rows, const LinearSolution& solution, RobustLoss loss,
    const ReferenceScale& reference, ResidualPass* pass,
    const LinearCalibration& result);

}  // namespace armcal
