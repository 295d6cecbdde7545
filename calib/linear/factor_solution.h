#pragma once

#include <vector>

#include "calib/linear/calibration.h"
#include "calib/linear/identifiability.h"
#include "calib/linear/log_factors.h"
#include "calib/linear/solution.h"
#include "model/dynamics/model_parameters.h"
#include "model/robot/robot.h"
#include "problems/identification_rows.h"

namespace armcal {

// What the logs behind `factors` are judged against; `motion_hz`: about where
// the spectrum of their motion lies.
ReferenceScale MakeReference(const ModelParameters& parameters,
                             const RowOptions& rows, double motion_hz,
                             const LogFactors& factors);

// The solution from the factor alone. Sets noise, ranks, and whether and why
// it is one in `result`. The noise of `frozen` joints does not follow the
// parameters.
LinearSolution SolveFactor(const BlockTriangularFactor& factor,
                           const ReferenceScale& reference,
                           const std::vector<bool>& frozen, LinearSolver solver,
                           LinearCalibration* result);

// Adds what all torques of a joint that are off by one factor make of x, to
// first order, and sets the deviations:
//   covariance += sigma^2 sum_i (dx / de_i) (dx / de_i)',
// e_i ~ N(0, sigma^2) independent of each other and of the noise.
void AddScaleCovariance(const LinearSolution& solution,
                        LinearCalibration* result);

// How much larger standard deviations are than those of independent rows, the
// median; at least 1.
double MedianInflation(const Eigen::MatrixXd& covariance,
                       const Eigen::MatrixXd& independent);

}  // namespace armcal
