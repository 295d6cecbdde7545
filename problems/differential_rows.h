#pragma once

#include "problems/identification_rows.h"

namespace armcal {

// The differential model (2.19): tau = U(q, qd, qdd) X at sample times. With a
// bandwidth both sides are low-passed alike and taken 4 times per period of it;
// without one every sample is a row.
void ForEachDifferentialRow(const Trajectory& trajectory,
                            const RowOptions& options,
                            MotionRegressor* regressor, const RowSink& sink);

double DifferentialReach(const RowOptions& options);

}  // namespace armcal
