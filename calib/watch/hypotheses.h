#pragma once

#include <vector>

#include "calib/watch/information.h"
#include "calib/watch/model.h"

namespace armcal {

// What may have changed: a payload on the last link, friction of each joint
// (viscous, Coulomb, offset), a wrench of constant world axes on the last link.
// The first is the payload, then come the joints in their order. Each has a
// prior as wide as such changes are on this arm (its source has the numbers):
// half of a joint's friction, a payload of a tenth of what the arm lifts.
std::vector<WatchHypothesis> MakeWatchHypotheses(const WatchModel& model);

// Adds the covariance of a change to that of the parameters; a wrench is none.
Eigen::MatrixXd WithChange(const Eigen::MatrixXd& covariance,
                           const WatchHypothesis& change,
                           const Eigen::VectorXd& variance);

}  // namespace armcal
