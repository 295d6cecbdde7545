#pragma once

#include <Eigen/Core>

#include "calib/poses/fit.h"
#include "calib/refine/arm_unknowns.h"

namespace armcal {

// What measured poses tell of an arm's unknowns at some values, a column for
// each of these.
struct PoseInformation {
  // A of the information A'A that a fit has of them: the Jacobian, whitened.
  Eigen::MatrixXd rows;
  // F with F'F the covariance of their errors' pull at the estimate, A'A where
  // errors are independent. What errors share is told from what a fit of poses
  // alone would leave: where priors or torques hold unknowns, it is that much
  // at most. Readings of one pose, and neighbouring poses, share
  // theirs (calib/poses/shared_errors.h).
  Eigen::MatrixXd scores;
};

// `poses`: null without measured poses.
PoseInformation InformByPoses(const ArmUnknowns& unknowns, const PoseFit* poses,
                              const ArmValues& at);

}  // namespace armcal
