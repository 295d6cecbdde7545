#include "calib/linear/width_covariance.h"

#include <algorithm>
#include <vector>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// How many rows in a sequence share noise for certain: weak rows overlap, and
// what differentiation makes of encoder noise lasts about a third of a second.
int CorrelatedRows(const RowOptions& rows) {
  const bool differential =
      rows.identification == Identification::kDifferential;
  if (!differential || rows.bandwidth_hz <= 0) return rows.hops;
  return std::max(rows.hops, static_cast<int>(0.33 * 4 * rows.bandwidth_hz));
}

// The model with the widths of Coulomb friction unknown as well. Every joint
// has a second Coulomb column, of a width 10 % greater. The difference of both
// is the derivative by the width to first order, so that together they span its
// column and a linear solution's covariance includes it. base[k] is the
// parameter that column k stands for.
struct WidthsUnknown {
  WidthsUnknown(const Robot& robot, const LinearCalibrationOptions& options,
                const LinearCalibration& result)
      : parameters(MakeParameters(robot, options, Wider(result.transitions))) {
    int next = -1, last_block = -1;
    for (const ModelParameter& p : parameters.parameters()) {
      const bool coulomb = p.is_joint_term && p.term == JointTerm::kCoulomb;
      if (!coulomb || p.block != last_block) ++next;
      last_block = coulomb ? p.block : -1;
      base.push_back(next);
    }
  }
  static Transitions Wider(const std::vector<CoulombTransition>& chosen) {
    Transitions wider;
    for (CoulombTransition t : chosen) {
      wider.push_back({t});
      t.width *= 1.1;
      wider.back().push_back(t);
    }
    return wider;
  }
  // Values of the base parameters, on the first column of each.
  VectorXd Spread(const VectorXd& x) const {
    VectorXd spread = VectorXd::Zero(parameters.size());
    for (int k = 0; k < parameters.size(); ++k) {
      if (k == 0 || base[k] != base[k - 1]) spread[k] = x[base[k]];
    }
    return spread;
  }
  // Base parameters add up their columns.
  MatrixXd Fold() const {
    MatrixXd fold = MatrixXd::Zero(base.back() + 1, parameters.size());
    for (int k = 0; k < parameters.size(); ++k) fold(base[k], k) = 1;
    return fold;
  }

  ModelParameters parameters;
  std::vector<int> base;
};

}  // namespace

// A width that was fitted is an unknown like the others: taken for given, it
// would leave Coulomb and viscous friction, which trade with it, too sure.
CovarianceEstimate EstimateCovariance(
    const Robot& robot, const LinearCalibrationOptions& options,
    const RowOptions& rows, const LinearSolution& solution, RobustLoss loss,
    const ReferenceScale& reference, ResidualPass* pass,
    const LinearCalibration& result) {
  const int correlated = CorrelatedRows(rows);
  if (result.transitions.empty() || options.transition || !solution.weighted) {
    const Eigen::Index m = solution.x.size();
    return EstimateRowCovariance(solution, result.noise, loss, reference,
                                 MatrixXd::Identity(m, m), result.equations,
                                 correlated, pass);
  }
  const WidthsUnknown wider(robot, options, result);
  LinearSolution spread = solution;
  spread.x = wider.Spread(solution.x);
  ReferenceScale columns = reference;
  columns.columns = reference.columns(Eigen::all, wider.base);
  ResidualPass wider_pass = pass->WithParameters(wider.parameters);
  return EstimateRowCovariance(spread, result.noise, loss, columns,
                               wider.Fold(), result.equations, correlated,
                               &wider_pass);
}

}  // namespace armcal
