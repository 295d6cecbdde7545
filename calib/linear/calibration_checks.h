#pragma once

#include <optional>
#include <string>

#include "calib/linear/log_factors.h"
#include "calib/logs/log_set.h"
#include "calib/logs/torque_residual.h"
#include "model/dynamics/model_parameters.h"
#include "problems/identification_rows.h"

namespace armcal {

// Whether options fit the logs; InputError says what would.
void CheckBandwidth(const std::optional<double>& given, const LogSet& training);
void CheckIntervals(const RowOptions& rows, const LogSet& training,
                    long equations);

// Why the equations of the logs can have no solution; empty if they can.
std::string WhyNothingToSolve(const LogFactors& factors,
                              const ModelParameters& parameters);

// Throws InputError where what a held-out log leaves is beyond what squares can
// hold.
void CheckNoOverflow(const TorqueResidual& residual, const LogSet& held_out);

}  // namespace armcal
