#pragma once

#include "problems/identification_rows.h"

namespace armcal {

// The weak form: for a test function phi that vanishes at both ends,
//   int phi tau dt = sum_c X_c [ - int phi' P_c dt - int phi D_c dt ],
// with phi(s) = (1 - s^2)^4 on s in [-1, 1], scaled to int phi dt = 1 so that
// rows are mean torques (N m). No acceleration enters, and velocity only inside
// smooth averages (MATH.md D2); a box for phi would give (2.27). The trapezoid
// rule has order 4 for it: with 50 samples in a window, 1e-6 of the torque.
// Windows start at multiples of their hop from the segment's first sample.
void ForEachWeakRow(const Trajectory& trajectory, const RowOptions& options,
                    MotionFunctions* functions, const RowSink& sink);

}  // namespace armcal
