#include "calib/diagnose/judge/description.h"

#include <cmath>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/candidates/line_of_motion.h"
#include "calib/diagnose/data/column_prior.h"
#include "calib/diagnose/data/estimate_deviations.h"
#include "calib/diagnose/select/chosen.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Estimates of an effect in the units of a report, with standard deviations by
// the delta method (EstimateDeviations) from the covariance of its fitted
// parameters.
void DescribeFitted(const GapFit& fit, const GapCandidate& effect,
                    const MatrixXd& covariance, FoundEffect* found) {
  const EffectSite site = {&fit.baseline().robot(), effect.joint, &fit.scale()};
  const std::vector<EffectEstimate> estimates =
      EstimatesOf(*effect.effect, site, effect.p);
  const std::vector<double> stddev = EstimateDeviations(
      *effect.effect, site, effect.p, covariance,
      fit.baseline().discrepancy().torque_constants_stddev());
  found->estimates.insert(found->estimates.end(), estimates.begin(),
                          estimates.end());
  found->stddev.insert(found->stddev.end(), stddev.begin(), stddev.end());
  const GapRegression& regression = fit.regression();
  const std::vector<double> by_scale =
      EstimateDeviations(*effect.effect, site, effect.p, covariance, 0);
  found->stddev_by_scale.insert(found->stddev_by_scale.end(), by_scale.begin(),
                                by_scale.end());
  found->is_possible = IsPossible(effect, *site.robot, *site.scale) &&
                       regression.CouldHaveLost(effect, fit.refined().effects);
  if (SwingsInTime(*effect.effect)) {
    found->of_motions_line = IsLineOfMotion(
        fit.baseline().robot(), fit.rows(), effect.joint, effect.log,
        regression.TorqueOf({effect})[effect.joint],
        NumberOf(effect.effect->numbers(site, effect.p), "frequency"));
  }
  const std::vector<bool>& swings = fit.scale().swings;
  found->of_idle_drive = effect.effect->of_the_drive && effect.joint >= 0 &&
                         !swings.empty() && swings[effect.joint];
}

void WidenByJoints(const GapFit& fit, const GapCandidate& effect,
                   const JointAgreement& agreement, FoundEffect* found) {
  const double variance = agreement.VarianceBetweenJoints();
  if (!(variance > 0)) return;
  const EffectSite site = {&fit.baseline().robot(), effect.joint, &fit.scale()};
  const std::vector<double> more = EstimateDeviations(
      *effect.effect, site, effect.p, MatrixXd::Constant(1, 1, variance), 0);
  for (size_t i = 0; i < more.size(); ++i) {
    found->stddev[i] = std::hypot(found->stddev[i], more[i]);
    found->stddev_by_scale[i] = std::hypot(found->stddev_by_scale[i], more[i]);
  }
}

// A missing term's values are those of the model with the effects, told for the
// joints where the data have narrowed its prior: covariance(c, c) is the
// posterior variance in units of the prior's, and one near 1 is the prior
// itself. A torque scale that is known to a share adds that share of the value
// to its deviation.
void DescribeMissingTerm(const GapFit& fit, const MatrixXd& covariance,
                         FoundEffect* found) {
  const GapBaseline& baseline = fit.baseline();
  const VectorXd& x = fit.model_after();
  const Robot robot = baseline.With(x);
  const JointTerm term = *found->missing_term;
  for (int c = 0; c < baseline.size(); ++c) {
    const BaselineColumn& column = baseline.columns()[c];
    if (column.kind != BaselineColumn::Kind::kTerm) continue;
    if (static_cast<JointTerm>(column.index) != term) continue;
    if (!IsToldByData(covariance(c, c))) continue;
    const Joint& joint = robot.links[column.joint].joint;
    const std::string unit = JointTermUnit(term, joint.type);
    const double value = TermOf(term, joint);
    found->estimates.push_back(
        {joint.name + "." + JointTermName(term), unit, value});
    found->stddev.push_back(WithTorqueScale(
        std::sqrt(covariance(c, c)) * column.spread, value, unit,
        baseline.discrepancy().torque_constants_stddev()));
  }
}

// The parameters of all effects stand one after the other in the covariance.
MatrixXd CovarianceOf(const RefinedEffects& refined, size_t k) {
  Eigen::Index begin = 0;
  for (size_t i = 0; i < k; ++i) begin += refined.effects[i].p.size();
  const Eigen::Index size = refined.effects[k].p.size();
  return refined.covariance.block(begin, begin, size, size);
}

}  // namespace armcal
