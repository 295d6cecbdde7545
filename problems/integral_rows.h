#pragma once

#include "problems/identification_rows.h"

namespace armcal {

// The integral model (2.27): over an interval (t1, t2),
//   int tau dt = sum_c X_c [ P_c(t2) - P_c(t1) - int D_c dt ],
// by the trapezoid or Simpson's rule on the samples; the ends are moved to the
// nearest sample. A given interval is assigned to the trajectory whose core
// holds its beginning, and left out where a gap cuts it.
void ForEachIntegralRow(const Trajectory& trajectory, const RowOptions& options,
                        MotionRegressor* regressor, const RowSink& sink);

}  // namespace armcal
