#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/effects/effect.h"

namespace armcal {

// The standard deviation of a value in `unit` that has been read off torques
// whose scale has this relative standard deviation, which comes on top of
// `stddev`: what has a mass in its dimension (kg, N m, N m s/rad ..) is off by
// as much as torque is, times and angles are not.
double WithTorqueScale(double stddev, double value, const std::string& unit,
                       double scale_stddev);

// Standard deviations of what an effect says of itself at p, by its derivatives
// there and by the torque's scale; covariance: of p.
std::vector<double> EstimateDeviations(const Effect& effect,
                                       const EffectSite& site,
                                       const Eigen::VectorXd& p,
                                       const Eigen::MatrixXd& covariance,
                                       double scale_stddev);

}  // namespace armcal
