#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/data/baseline_fit.h"

namespace armcal {

// Squared norms of BaselineFit::ResidualGiven of many torques, at a fraction of
// the time and to some 1e-9 of what the rows' squares sum up to: for ranking
// them.
Eigen::VectorXd Chi2Given(const BaselineFit& fit,
                          const std::vector<JointRows>& torques);

}  // namespace armcal
