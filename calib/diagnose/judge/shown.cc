#include "calib/diagnose/judge/shown.h"

#include "calib/diagnose/data/estimate_deviations.h"

namespace armcal {

using Eigen::MatrixXd;

// Laws that a reference shows by itself, with the values and the deviations
// that all logs together give them. Their parameters are the last columns of
// the baseline, so that their covariance is a corner of its, scaled from units
// of the column to those of the law.
std::vector<ShownEffect> ListShown(const GapFit& fit,
                                   const Eigen::VectorXd& x) {
  const GapBaseline& baseline = fit.baseline();
  const auto& parameters = baseline.known().parameters();
  const auto count = static_cast<Eigen::Index>(parameters.size());
  const MatrixXd all =
      fit.screen().BaselineCovariance().bottomRightCorner(count, count);
  std::vector<ShownEffect> shown;
  for (const KnownEffect& known : baseline.KnownAt(x)) {
    const int place = static_cast<int>(shown.size());
    MatrixXd covariance = MatrixXd::Zero(known.p.size(), known.p.size());
    for (Eigen::Index a = 0; a < count; ++a) {
      for (Eigen::Index b = 0; b < count; ++b) {
        const auto &u = parameters[a], &v = parameters[b];
        if (u.effect != place || v.effect != place) continue;
        covariance(u.index, v.index) = all(a, b) * u.spread * v.spread;
      }
    }
    const EffectSite site = {&baseline.robot(), known.joint,
                             &baseline.known().scale()};
    shown.push_back(
        {known.effect, known.joint, EstimatesOf(*known.effect, site, known.p),
         EstimateDeviations(*known.effect, site, known.p, covariance,
                            baseline.discrepancy().torque_constants_stddev())});
  }
  return shown;
}

}  // namespace armcal
