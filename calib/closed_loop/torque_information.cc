#include "calib/closed_loop/torque_information.h"

#include <Eigen/QR>
#include <algorithm>
#include <vector>

#include "calib/closed_loop/values.h"
#include "calib/numerics/posterior.h"
#include "calib/refine/arm_fit.h"
#include "calib/refine/arm_unknowns.h"
#include "calib/refine/link_equations.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<int> OffsetColumns(int n) {
  std::vector<int> columns;
  for (int k = 0; k < 4 * n; ++k) {
    if (kLoopTerms[k % 4] == JointTerm::kOffset) columns.push_back(10 * n + k);
  }
  return columns;
}

// For each column of R, the coefficients by which the `known` columns explain
// it best.
MatrixXd Explained(const MatrixXd& R, const std::vector<int>& known) {
  return MatrixXd(R(Eigen::all, known))
      .completeOrthogonalDecomposition()
      .solve(R);
}

// By how much scores may scatter more than the few windows of short logs say:
// what errors that are correlated only where rows overlap make of variances is
// known without these, and of no unknown may it be more.
double Excess(const ArmUnknowns& unknowns, const LinkInformation& information,
              const MatrixXd& prior) {
  constexpr double kSeen = 1e-3;  // of the variance, by data
  const std::vector<int> free = unknowns.FreeIndices();
  const Posterior posterior(information.R, prior, free);
  const VectorXd all = posterior.Gain().diagonal();
  const VectorXd told =
      posterior.Sandwich(SquareRoot(information.S)).diagonal();
  double excess = 1;
  for (const int k : free) {
    if (told[k] < kSeen * all[k]) continue;
    excess = std::max(excess, information.least[k] / told[k]);
  }
  return excess;
}

}  // namespace

// Equations about the estimate that the torques give alone. Offsets are
// projected out of rows (what they explain is subtracted, Frisch & Waugh 1933)
// and out of scores likewise: an offset may be a sensor's, which the loop does
// not feel.
TorqueInformation InformByTorques(const Robot& robot,
                                  const LinearCalibration& linear,
                                  const NonlinearCalibrationOptions& options,
                                  const LogSet& logs) {
  TorqueInformation result;
  const NonlinearCalibration alone =
      CalibrateNonlinear(robot, linear, options, logs, nullptr);
  result.reason = alone.converged() ? "" : alone.reason;
  if (!alone.converged()) return result;
  const ArmUnknowns unknowns(alone.robot, linear, RefineGeometry::kNothing,
                             nullptr);
  const int n = robot.num_joints(), size = 14 * n;
  const ArmValues& at = unknowns.nominal();
  const VectorXd noise = EquationNoise(linear);
  LinkPass pass(unknowns, linear, options.progress,
                Prepare(logs, linear.preparation));
  const LinkEquations equations = pass.Reduce(at, noise);
  const ArmFit fit(unknowns, options.trust, nullptr);
  const MatrixXd prior = fit.PriorInformation(options.trust);
  const LinkInformation information =
      pass.Inform(at, noise, fit.InformByPoses(at).rows, prior);
  result.x = at.Stacked().head(size);

  const std::vector<int> offsets = OffsetColumns(n);
  MatrixXd rows(equations.R.rows(), size + 1);
  rows << equations.R.leftCols(size), equations.z;
  rows -= MatrixXd(rows(Eigen::all, offsets)) * Explained(rows, offsets);
  result.R = rows.leftCols(size);
  result.z = rows.col(size);
  const MatrixXd R = information.R.leftCols(size);
  MatrixXd scores = MatrixXd::Identity(size, size);
  scores(Eigen::all, offsets) -= Explained(R, offsets).transpose();
  result.S = Excess(unknowns, information, prior) * scores *
             information.S.topLeftCorner(size, size) * scores.transpose();
  return result;
}

}  // namespace armcal
