#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/linear/calibration.h"
#include "calib/linear/overlap_covariance.h"
#include "calib/linear/score_covariance.h"
#include "calib/logs/prepared_logs.h"
#include "calib/refine/arm_unknowns.h"

namespace armcal {

// The torque equations of logs, R x = z, in all of an arm's unknowns x (columns
// of those that torques do not see are 0). They are whitened, weighted by
// the linear calibration's loss, compressed to a triangle, and linear about
// some values in the geometry; z is such that x are the unknowns themselves.
struct LinkEquations {
  Eigen::MatrixXd R;
  Eigen::VectorXd z;
  // Per joint, the robust spread of the residuals at those values in units of
  // the noise given, 0 where no equation is used.
  Eigen::VectorXd spread;
};

// What the torque equations tell about the unknowns at some values.
struct LinkInformation {
  // Of the equations, by the slope of the loss: their information is R'R.
  Eigen::MatrixXd R;
  // The covariance of the sum of scores, autocorrelation allowed for
  // (Newey-West as the linear calibration's).
  Eigen::MatrixXd S;
  Eigen::MatrixXd log_sums;  // of scores, a column per log
  // How that sum changes with the scale of a joint's torque, d / d e_i where it
  // is 1 + e_i times as large; a column per joint.
  Eigen::MatrixXd scale_sums;
  // Variances that errors make which are correlated only where rows overlap.
  Eigen::VectorXd least;
};

// Standard deviations of a linear calibration's weak rows, per joint, but at
// least a little of the torque: logs without noise would have what is left of
// the filters pull estimates off what else is measured.
Eigen::VectorXd EquationNoise(const LinearCalibration& linear);

// Passes over the logs. `noise`: standard deviations per joint of the weak
// rows; those of rows that follow each other tell less than their number, which
// the linear calibration's inflation stands for.
class LinkPass {
 public:
  LinkPass(const ArmUnknowns& unknowns, const LinearCalibration& linear,
           const Progress& progress, const PreparedLogs& logs);

  LinkEquations Reduce(const ArmValues& at, const Eigen::VectorXd& noise);
  // With fitted widths of Coulomb friction, which friction and armature share,
  // as unknowns of their own that are eliminated. `others`: rows of other data,
  // whitened, and `prior`, the prior's information. Two passes.
  LinkInformation Inform(const ArmValues& at, const Eigen::VectorXd& noise,
                         const Eigen::MatrixXd& others,
                         const Eigen::MatrixXd& prior);

 private:
  struct Residual;
  struct Columns;
  FittedRow MakeFittedRow(const Residual& residual, const Columns& columns,
                          const Eigen::VectorXd& noise) const;
  Eigen::MatrixXd Gain(const Eigen::MatrixXd& R, const Columns& columns,
                       const Eigen::MatrixXd& others,
                       const Eigen::MatrixXd& prior) const;
  void ForEachResidual(const std::string& stage, const ArmValues& at,
                       const Eigen::VectorXd& noise,
                       const std::vector<JointTermColumn>& terms,
                       const std::function<void(const Residual&)>& visit);

  const ArmUnknowns& unknowns_;
  const LinearCalibration& linear_;
  Progress progress_;
  PreparedLogs logs_;
};

}  // namespace armcal
