#pragma once

#include <Eigen/Core>

#include "calib/diagnose/judge/found_effect.h"
#include "calib/diagnose/select/fit.h"

namespace armcal {

// Of the k-th refined effect's parameters.
Eigen::MatrixXd CovarianceOf(const RefinedEffects& refined, size_t k);

// Adds estimates and deviations of one of the fit's effects; covariance: of its
// parameters.
void DescribeFitted(const GapFit& fit, const GapCandidate& effect,
                    const Eigen::MatrixXd& covariance, FoundEffect* found);

// Widens the deviations of an effect of all joints, whose estimates are told,
// by what its joints' sizes scatter by.
void WidenByJoints(const GapFit& fit, const GapCandidate& effect,
                   const JointAgreement& agreement, FoundEffect* found);

// Adds each joint's value of a term that the file gives no joint, as it is
// given the fit's effects, whose torque a fit without them had taken for it.
// A joint that does not show it has none. `covariance`: of the baseline.
void DescribeMissingTerm(const GapFit& fit, const Eigen::MatrixXd& covariance,
                         FoundEffect* found);

}  // namespace armcal
