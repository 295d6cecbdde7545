#pragma once

#include <Eigen/Core>
#include <string>

#include "calib/linear/calibration.h"
#include "calib/logs/log_set.h"
#include "calib/refine/nonlinear_calibration.h"
#include "model/robot/robot.h"

namespace armcal {

// What logs with torques say of an arm's links (10 n, ToVector()'s order) and
// joint terms (4 n, kLoopTerms of each joint), for an estimate that knows other
// things of them too. Of n joints, x has 14 n entries. Constant torques are the
// recording's own, a sensor's as likely as a joint's: they are eliminated.
struct TorqueInformation {
  std::string reason;  // why there is nothing; empty: there is
  Eigen::VectorXd x;   // what they say alone, with the robot file as prior
  // R x = z, whitened: their information is R'R.
  Eigen::MatrixXd R;
  Eigen::VectorXd z;
  // The covariance of R'(R x - z), autocorrelation allowed for.
  Eigen::MatrixXd S;
};

// `linear`: of the same logs and robot.
TorqueInformation InformByTorques(const Robot& robot,
                                  const LinearCalibration& linear,
                                  const NonlinearCalibrationOptions& options,
                                  const LogSet& logs);

}  // namespace armcal
