#include "calib/diagnose/judge/shown.h"

#include <Eigen/Eigenvalues>
#include <boost/math/distributions/chi_squared.hpp>

#include "calib/diagnose/data/estimate_deviations.h"
#include "calib/diagnose/data/thresholds.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// W = p' C^+ p is chi squared with the rank of C as its degrees of freedom
// where p is 0 (Wald 1943). C is looked at in units of its deviations.
bool AreSignificant(const VectorXd& p, const MatrixXd& covariance) {
  constexpr double kLeast = 1e-9;  // of the largest eigenvalue
  if (p.size() == 0) return true;
  const VectorXd unit =
      covariance.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(
      unit.asDiagonal() * covariance * unit.asDiagonal());
  const VectorXd along =
      eigen.eigenvectors().transpose() * unit.cwiseProduct(p);
  double W = 0;
  int rank = 0;
  for (Eigen::Index k = 0; k < p.size(); ++k) {
    if (eigen.eigenvalues()[k] <= kLeast * eigen.eigenvalues()[p.size() - 1]) {
      continue;
    }
    W += along[k] * along[k] / eigen.eigenvalues()[k];
    ++rank;
  }
  if (rank == 0) return true;  // known exactly
  const boost::math::chi_squared chi_squared(rank);
  return boost::math::cdf(chi_squared, W) > Limits().credible;
}

// Laws that a reference shows by itself, with the values and the deviations
// that a fit to the reference gives them. Their parameters are columns of the
// baseline, so that their covariance is a block of its, scaled from units of
// the column to those of the law.
std::vector<ShownEffect> ListShown(const GapFit& fit) {
  const GapBaseline& baseline = fit.baseline();
  const auto& parameters = baseline.known().parameters();
  const auto count = static_cast<Eigen::Index>(parameters.size());
  std::vector<ShownEffect> shown;
  if (count == 0) return shown;
  const MatrixXd all = fit.CovarianceBefore().block(
      baseline.known_begin(), baseline.known_begin(), count, count);
  for (const KnownEffect& known : baseline.KnownAt(fit.before())) {
    const int place = static_cast<int>(shown.size());
    MatrixXd covariance = MatrixXd::Zero(known.p.size(), known.p.size());
    std::vector<int> fitted;  // of p
    for (Eigen::Index a = 0; a < count; ++a) {
      for (Eigen::Index b = 0; b < count; ++b) {
        const auto &u = parameters[a], &v = parameters[b];
        if (u.effect != place || v.effect != place) continue;
        covariance(u.index, v.index) = all(a, b) * u.spread * v.spread;
      }
    }
    for (const auto& one : parameters) {
      if (one.effect == place) fitted.push_back(one.index);
    }
    const EffectSite site = {&baseline.robot(), known.joint,
                             &baseline.known().scale()};
    shown.push_back(
        {known.effect, known.joint, EstimatesOf(*known.effect, site, known.p),
         EstimateDeviations(*known.effect, site, known.p, covariance,
                            baseline.discrepancy().torque_constants_stddev()),
         AreSignificant(known.p(fitted), covariance(fitted, fitted))});
  }
  return shown;
}

}  // namespace armcal
