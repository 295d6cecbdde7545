#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/effects/effect.h"

namespace armcal {

// Standard deviations of what an effect says of itself at p, by its derivatives
// there; covariance: of p.
std::vector<double> EstimateDeviations(const Effect& effect,
                                       const EffectSite& site,
                                       const Eigen::VectorXd& p,
                                       const Eigen::MatrixXd& covariance);

}  // namespace armcal
