#pragma once

#include <ceres/problem.h>
#include <ceres/solver.h>

namespace armcal {

// Solves a problem of up to some hundred unknowns: Gauss-Newton by dense QR,
// damped only where a step fails. Ceres' usual damping is relative to the data:
// it would stop directions that only a prior determines where they started.
// Where that does not come to rest, the usual damping leads from the start to
// where it does. `function_tolerance`, relative to the cost: of N residuals,
// 1e-12 leaves parameters within about 1e-6 sqrt(N) of their standard
// deviations; 1e-15 is what rounding leaves.
ceres::Solver::Summary SolveDense(double function_tolerance,
                                  ceres::Problem* problem);

}  // namespace armcal
