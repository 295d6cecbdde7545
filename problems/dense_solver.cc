#include "problems/dense_solver.h"

#include <algorithm>
#include <vector>

namespace armcal {
namespace {

// Trust region radii: of no damping, and of Ceres' usual one.
constexpr double kUndamped = 1e16, kDamped = 1e4;

// One run of Ceres' Levenberg-Marquardt. Steps come from a QR factorisation of
// the Jacobian J and not from the normal equations: these have the square of
// J's condition number, and with it they lose the directions that only a weak
// prior holds (Golub & Van Loan, Matrix Computations, 5.3). Ceres damps by
// sqrt(diag(J'J) / radius), so that the first radius says how much.
ceres::Solver::Summary Solve(double radius, int iterations,
                             double function_tolerance,
                             ceres::Problem* problem) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = iterations;
  options.function_tolerance = function_tolerance;
  options.gradient_tolerance = 0;  // depends on the parameters' units
  options.parameter_tolerance = 1e-12;
  options.initial_trust_region_radius = radius;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, problem, &summary);
  return summary;
}

// The values of all blocks of a problem.
class Values {
 public:
  explicit Values(const ceres::Problem& problem) {
    problem.GetParameterBlocks(&blocks_);
    for (const double* block : blocks_) {
      values_.emplace_back(block, block + problem.ParameterBlockSize(block));
    }
  }
  void Restore() const {
    for (size_t k = 0; k < blocks_.size(); ++k) {
      std::copy(values_[k].begin(), values_[k].end(), blocks_[k]);
    }
  }

 private:
  std::vector<double*> blocks_;
  std::vector<std::vector<double>> values_;
};

}  // namespace

ceres::Solver::Summary SolveDense(double function_tolerance,
                                  ceres::Problem* problem) {
  const Values start(*problem);
  ceres::Solver::Summary summary =
      Solve(kUndamped, 300, function_tolerance, problem);
  if (summary.termination_type != ceres::NO_CONVERGENCE) return summary;
  start.Restore();
  Solve(kDamped, 1000, function_tolerance, problem);
  return Solve(kUndamped, 300, function_tolerance, problem);
}

}  // namespace armcal
