#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/drive_gains/current_pass.h"
#include "calib/drive_gains/solution.h"
#include "problems/robust_loss.h"

namespace armcal {

// What the current equations of logs of a bare and a loaded arm fit best.
struct GainFit {
  std::string failure;  // empty: it worked
  GainEstimate estimate;
  int reference = 0;           // the joint whose g is 1
  Eigen::VectorXd noise;       // per joint, A; 0: its equations are left out
  std::vector<long> outliers;  // per joint, equations weighed below 1/2
  long equations = 0;          // per joint
  CurrentFactors factors;      // of all equations alike
};

// One pass for a start without knowledge, noise per joint re-estimated until it
// stays; then, but for kSquared, reweighted least squares with `loss`, a pass
// for each, as SolveRobust does it. `nominal`: the robot file's parameters, a
// guess of the gains' ratios where a motion cannot show them.
GainFit FitGains(const Eigen::VectorXd& nominal, RobustLoss loss,
                 CurrentPass* pass);

// 1 / K_j as a product of the estimate's entries, times the payload's mass, and
// its gradient by (g, x, p).
double MassTimesInverseGain(const GainEstimate& estimate, int joint);
Eigen::VectorXd MassTimesInverseGainGradient(const GainFit& fit, int joint);

}  // namespace armcal
