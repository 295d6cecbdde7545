#pragma once

#include <ceres/problem.h>
#include <ceres/solver.h>

namespace armcal {

// Solves a problem of up to some hundred unknowns: Gauss-Newton by dense QR,
// damped only where a step fails. Ceres' usual damping is relative to the data:
// it would stop directions that only a prior determines where they started.
ceres::Solver::Summary SolveDense(double function_tolerance,
                                  ceres::Problem* problem);

}  // namespace armcal
