#include "calib/linear/used_equations.h"

#include "calib/linear/solution.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

EquationMask Both(const EquationMask& a, const EquationMask& b) {
  EquationMask both = a;
  for (size_t log = 0; log < a.size(); ++log) {
    for (size_t i = 0; i < a[log].size(); ++i) {
      both[log][i] = a[log][i] && b[log][i];
    }
  }
  return both;
}

}  // namespace

UsedEquations AllEquations(const LogFactors& factors, int num_joints) {
  return {EquationMask(factors.size(), std::vector<bool>(num_joints, true)),
          std::vector<bool>(num_joints, false),
          {}};
}

// The robot file's inertia judges first, since without any scale the logs judge
// themselves by a solution that may be the arm without mass. The logs' own
// solution judges then, twice, as what it leaves out changes it.
UsedEquations FindUsedEquations(const LogFactors& factors,
                                const ModelParameters& parameters,
                                const ReferenceScale& reference) {
  const int n = parameters.num_joints();
  const EquationMask by_robot =
      FindPowered(factors, parameters.nominal(), 0.05);
  EquationMask powered = by_robot;
  for (int round = 0; round < 2; ++round) {
    const BlockTriangularFactor merged = factors.Merged(parameters, powered);
    VectorXd noise = RightSideRms(merged);
    const LinearSolution solution =
        SolveReweighted(merged, reference, std::vector<bool>(n, false), &noise);
    powered = Both(by_robot, FindPowered(factors, solution.x, 0.1));
  }
  UsedEquations result{powered, std::vector<bool>(n, true), {}};
  for (int i = 0; i < n; ++i) {
    for (int log = 0; log < factors.size(); ++log) {
      if (powered[log][i]) {
        result.frozen[i] = false;
      } else {
        result.unpowered.push_back({log, i, RightSideRms(factors.log(log))[i]});
      }
    }
    if (!result.frozen[i]) continue;
    for (auto& joints : result.used) joints[i] = true;
  }
  return result;
}

}  // namespace armcal
