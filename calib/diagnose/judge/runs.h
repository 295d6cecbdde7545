#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/diagnose/select/fit.h"

namespace armcal {

// A joint's friction or offset that goes up or down from log to log.
struct RunDrift {
  std::string name;  // "<joint>.viscous"
  std::string unit;
  Eigen::VectorXd value, stddev;  // of each log, in their order
  double per_log = 0, per_log_stddev = 0;
};

// Of three logs or more: viscous and Coulomb friction and offset fitted to each
// given what was fitted to all, and those that follow a line over the logs by
// more than five standard deviations, as far as its scatter allows; x: the
// baseline's values.
std::vector<RunDrift> ListRunDrifts(const GapFit& fit,
                                    const Eigen::VectorXd& x);

}  // namespace armcal
