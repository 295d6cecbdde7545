#pragma once

// SixAxisProblem as one gives it to Ceres at first: a block per sample, with
// automatic derivatives.

#include <ceres/ceres.h>

#include <vector>

#include "tests/benchmarks/six_axis_problem.h"

namespace armcal {

struct SixAxisResidual {
  SixAxisSample sample;

  template <class T>
  bool operator()(const T* inertial, const T* dh, T* residual) const {
    SixAxisTorque<T> arm;
    arm.Evaluate(inertial, dh, sample, residual);
    for (int j = 0; j < SixAxisProblem::kJoints; ++j) {
      residual[j] -= sample.tau[j];
    }
    return true;
  }
};
using SixAxisBlock =
    ceres::AutoDiffCostFunction<SixAxisResidual, SixAxisProblem::kJoints,
                                SixAxisProblem::kInertial,
                                SixAxisProblem::kGeometric>;

// x minus where it is thought to be, with a weight that makes the problem full
// rank.
struct SixAxisPrior {
  std::vector<double> x0;
  double weight;

  template <class T>
  bool operator()(T const* const* x, T* residual) const {
    for (size_t k = 0; k < x0.size(); ++k) {
      residual[k] = weight * (x[0][k] - x0[k]);
    }
    return true;
  }
};

inline void AddSixAxisPrior(const std::vector<double>& x0, double weight,
                            double* x, ceres::Problem* problem) {
  auto* prior = new ceres::DynamicAutoDiffCostFunction<SixAxisPrior>(
      new SixAxisPrior{x0, weight});
  prior->AddParameterBlock(static_cast<int>(x0.size()));
  prior->SetNumResiduals(static_cast<int>(x0.size()));
  problem->AddResidualBlock(prior, nullptr, x);
}

// Both priors.
inline void AddSixAxisPriors(const SixAxisProblem& of, double* inertial,
                             double* geometric, ceres::Problem* problem) {
  AddSixAxisPrior(of.inertial, SixAxisProblem::kInertialPrior, inertial,
                  problem);
  AddSixAxisPrior(of.geometric, SixAxisProblem::kGeometricPrior, geometric,
                  problem);
}

}  // namespace armcal
