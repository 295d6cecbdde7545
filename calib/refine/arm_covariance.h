#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/refine/arm_fit.h"
#include "calib/refine/link_equations.h"

namespace armcal {

// How sure an estimate of an arm's unknowns is.
struct ArmCovariance {
  // Of the estimate's error, over the noise and over truths that the prior
  // allows; rows and columns of what is held are 0.
  Eigen::MatrixXd covariance;
  // Whether the data tell more of a parameter than the file would that is
  // trusted to 100 % (a geometric one: to its prior's deviation): without the
  // file its variance is less than doubled.
  std::vector<bool> identifiable;
  // Combinations of free parameters of which the data tell less than that.
  std::vector<std::string> unseen;
};

// The sandwich of information and scores of poses and torques, both at the
// estimate: torque rows overlap and have autocorrelated errors. Each joint's
// torque scale, of that relative standard deviation, adds what it makes of the
// estimate.
ArmCovariance EstimateArmCovariance(const ArmUnknowns& unknowns,
                                    const ArmFit& fit, const ArmTrust& trust,
                                    const PoseInformation& poses,
                                    const LinkInformation& torques,
                                    double torque_constants_stddev);

}  // namespace armcal
