#include "calib/diagnose/data/estimate_deviations.h"

#include <algorithm>
#include <cmath>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<double> EstimateDeviations(const Effect& effect,
                                       const EffectSite& site,
                                       const VectorXd& p,
                                       const MatrixXd& covariance) {
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
  for (const double v : variance) stddev.push_back(std::sqrt(std::max(v, 0.)));
  return stddev;
}

}  // namespace armcal
