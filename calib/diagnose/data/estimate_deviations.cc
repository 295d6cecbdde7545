#include "calib/diagnose/data/estimate_deviations.h"

#include <algorithm>
#include <cmath>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

double WithTorqueScale(double stddev, double value, const std::string& unit,
                       double scale_stddev) {
  const bool has_mass = unit.rfind("kg", 0) == 0 || unit.rfind('N', 0) == 0;
  return has_mass ? std::hypot(stddev, scale_stddev * value) : stddev;
}

// The delta method: an estimate is a function f of the fitted parameters with
// the gradient J, and var f = J C J'. J is taken by forward differences, a step
// of 1e-4 of a parameter's deviation, since estimates are laws' own formulas.
// What the torque constants have of uncertainty comes on top, as a share of
// estimates that hold a mass, and of factors of the torque itself: magnets lose
// .1 (neodymium) to .2 % (ferrite) of their field per kelvin, so that from log
// to log a drive's gain differs by itself as its motor warms. An estimate of
// which nothing tells has the deviation 0, which reports leave out.
std::vector<double> EstimateDeviations(const Effect& effect,
                                       const EffectSite& site,
                                       const VectorXd& p,
                                       const MatrixXd& covariance,
                                       double scale_stddev) {
  const std::vector<EffectEstimate> estimates = EstimatesOf(effect, site, p);
  MatrixXd J = MatrixXd::Zero(estimates.size(), p.size());
  for (int k = 0; k < p.size(); ++k) {
    VectorXd x = p;
    const double step = 1e-4 * std::sqrt(covariance(k, k));
    if (!(step > 0)) continue;
    x[k] += step;
    const auto moved = EstimatesOf(effect, site, x);
    for (size_t i = 0; i < estimates.size(); ++i) {
      J(i, k) = (moved[i].value - estimates[i].value) / step;
    }
  }
  const VectorXd variance = (J * covariance * J.transpose()).diagonal();
  std::vector<double> stddev;
  for (size_t k = 0; k < estimates.size(); ++k) {
    const double own = std::sqrt(std::max(variance[k], 0.));
    const double value = estimates[k].value;
    if (!(own > 0)) {
      stddev.push_back(0);  // nothing tells of it
    } else if (k == 0 && effect.estimates_a_factor) {
      stddev.push_back(std::hypot(own, scale_stddev * (1 + value)));
    } else {
      stddev.push_back(
          WithTorqueScale(own, value, estimates[k].unit, scale_stddev));
    }
  }
  return stddev;
}

}  // namespace armcal
