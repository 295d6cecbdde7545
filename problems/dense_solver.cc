#include "problems/dense_solver.h"

namespace armcal {

ceres::Solver::Summary SolveDense(double function_tolerance,
                                  ceres::Problem* problem) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 300;
  options.function_tolerance = function_tolerance;
  options.parameter_tolerance = 1e-12;
  options.initial_trust_region_radius = 1e16;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, problem, &summary);
  return summary;
}

}  // namespace armcal
