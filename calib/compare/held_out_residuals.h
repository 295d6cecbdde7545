#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calib/logs/log_set.h"
#include "model/dynamics/joint_term.h"
#include "model/robot/robot.h"
#include "model/text/progress.h"

namespace armcal {

// A robot whose torques are predicted on a log, and how its joints' Coulomb
// friction changes sign.
struct PredictingRobot {
  std::string name;
  Robot robot;
  std::vector<CoulombTransition> transitions;
};

// What a robot leaves of the torques of logs, low-passed, in percent of them:
// 100 |tau - tau_hat| / |tau|, in 2-norm.
struct HeldOutResidual {
  std::string name;
  Eigen::VectorXd percent;  // per joint
  double stacked_percent;   // all joints as one vector
};

// What robot `b` leaves over what `a` leaves, rms over joints of their relative
// residuals, with its interval of 95 % (block bootstrap over time).
struct ResidualRatio {
  int a, b;
  double value, low, high;
};

struct HeldOutResiduals {
  double bandwidth_hz;
  std::vector<HeldOutResidual> robots;
  std::vector<ResidualRatio> ratios;  // of each two
};

// Of robots of one kinematic structure on the same logs, at the same bandwidth:
// `bandwidth_hz`, or what suits the motion.
HeldOutResiduals CompareOnLogs(const std::vector<PredictingRobot>& robots,
                               std::optional<double> bandwidth_hz,
                               const Progress& progress, const LogSet& logs);

}  // namespace armcal
