#include "calib/torque_information.h"

#include <Eigen/QR>
#include <vector>

#include "calib/arm_fit.h"
#include "calib/arm_unknowns.h"
#include "calib/link_equations.h"
#include "calib/loop_values.h"

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

// By all columns, what those `known` explain of them.
MatrixXd Explained(const MatrixXd& R, const std::vector<int>& known) {
  return MatrixXd(R(Eigen::all, known))
      .completeOrthogonalDecomposition()
      .solve(R);
}

}  // namespace

TorqueInformation InformByTorques(const Robot& robot,
                                  const LinearCalibration& linear,
                                  const NonlinearCalibrationOptions& options,
                                  LogSet* logs) {
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
  LinkPass pass(unknowns, linear, options.progress, logs);
  const LinkEquations equations = pass.Reduce(at, noise);
  const ArmFit fit(unknowns, options.trust, nullptr);
  const LinkInformation information = pass.Inform(
      at, noise, fit.PoseRows(at), fit.PriorInformation(options.trust));
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
  result.S =
      scores * information.S.topLeftCorner(size, size) * scores.transpose();
  return result;
}

}  // namespace armcal
