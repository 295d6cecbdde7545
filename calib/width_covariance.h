#pragma once

#include "calib/calibration_model.h"
#include "calib/identifiability.h"
#include "calib/linear_solution.h"
#include "calib/residual_pass.h"
#include "calib/row_covariance.h"

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
