#pragma once

#include <memory>

#include "problems/identification_rows.h"

namespace armcal {

// How far rows reach beyond the sample they are assigned to, s.
double RowReach(const RowOptions& options);

// Of the trajectory that `regressor` has entered.
std::unique_ptr<IdentificationRows> MakeRows(const Trajectory& trajectory,
                                             const RowOptions& options,
                                             const MotionRegressor& regressor);

// Calls `sink` for every row of a trajectory, which is entered, in order.
void ForEachRow(const Trajectory& trajectory, const RowOptions& options,
                MotionRegressor* regressor, const RowSink& sink);

}  // namespace armcal
