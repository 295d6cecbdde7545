#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calib/diagnose/candidates/corrected_robot.h"
#include "calib/diagnose/select/fit.h"

namespace armcal {

// A parameter of the baseline that is far from where it was said to be.
struct MovedParameter {
  std::string name;  // "<link>.mass", "<joint>.viscous"
  std::string unit;
  double nominal = 0, value = 0, stddev = 0;
  double deviations = 0;  // of the prior
  std::optional<JointTerm> term;
};

// Those that the data move by more than two standard deviations of the prior
// and of their own, the farthest first; x: the baseline's values. With a
// reference: friction that is not what it was then, by more than two of its own
// and half of what is usual from day to day. What laws of Coulomb friction that
// were found (`effects`, a CorrectedRobot's with their shares) add to it along
// the logs is a part of it: doubled friction that builds up over a way is
// doubled friction.
std::vector<MovedParameter> ListMoved(
    const GapFit& fit, const Eigen::VectorXd& x,
    const std::vector<CarriedEffect>& effects);

}  // namespace armcal
