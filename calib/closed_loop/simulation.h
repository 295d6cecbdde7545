#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/closed_loop/stretch.h"
#include "calib/closed_loop/values.h"
#include "model/dynamics/joint_controller.h"

namespace armcal {

// What a simulated loop did, a row each period (and one more for where the arm
// was at its borders), joints in columns.
struct LoopTrack {
  bool finite = true;     // else nothing follows
  Eigen::MatrixXd q, qd;  // periods + 1 rows
  // Of the drives: q_ref - q; w - v; how far their torque was behind their
  // command, N m or N, at the begin.
  Eigen::MatrixXd error, velocity_error, behind;
  std::vector<DriveSlopes> slopes;  // of joint j in period k at n k + j
  ReferenceSeries reference;
  Eigen::VectorXd torque_squares;  // summed over periods

  // Measured minus simulated positions, joint j of row k at n k + j.
  Eigen::VectorXd Residual(const LoopStretch& stretch) const;
};

// Simulates stretches of logs side by side: the arm under drives that follow
// the log's command (JointController with DifferencedVelocity, lags).
std::vector<LoopTrack> SimulateLoop(
    const ControllerOptions& controller, const LoopValues& values,
    const std::vector<const LoopStretch*>& stretches,
    const std::vector<LoopStart>& starts);

}  // namespace armcal
