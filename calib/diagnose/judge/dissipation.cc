#include "calib/diagnose/judge/dissipation.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/judge/description.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

// Of a term that the baseline has, how well it knows that; covariance: the
// diagonal of the baseline's.
double StddevOf(const GapBaseline& baseline, const VectorXd& covariance,
                int joint, JointTerm term) {
  double variance = 0;
  for (size_t c = 0; c < baseline.columns().size(); ++c) {
    const BaselineColumn& column = baseline.columns()[c];
    const bool is_term = column.kind == BaselineColumn::Kind::kTerm ||
                         column.kind == BaselineColumn::Kind::kDay;
    if (!is_term || column.joint != joint) continue;
    if (static_cast<JointTerm>(column.index) != term) continue;
    variance += column.spread * column.spread * covariance[c];
  }
  return std::sqrt(variance);
}

// Whether the k-th effect is itself such a term, of which it leaves the joint
// less than none.
bool IsBelowNone(const GapFit& fit, size_t k, const Robot& with,
                 const VectorXd& covariance) {
  const GapCandidate& effect = fit.refined().effects[k];
  const std::optional<JointTerm> term = effect.effect->joint_term;
  if (!term || *term == JointTerm::kOffset) return false;
  const double value =
      TermOf(*term, with.links[effect.joint].joint) + effect.p[0];
  const double own = CovarianceOf(fit.refined(), k)(0, 0);
  const double stddev =
      std::hypot(std::sqrt(own),
                 StddevOf(fit.baseline(), covariance, effect.joint, *term));
  return value < -Limits().by_chance * stddev;
}

}  // namespace

bool MakesFrictionGivePower(const GapFit& fit, size_t k) {
  if (fit.regression().reference() != nullptr) return false;
  const std::vector<GapCandidate>& effects = fit.refined().effects;
  const VectorXd covariance = fit.screen().BaselineCovariance().diagonal();
  const Robot with = fit.baseline().With(fit.refined().baseline);
  const Robot without = fit.baseline().With(fit.regression().BaselineGiven(
      fit.regression().TorqueOf(AllBut(effects, k))));
  if (IsBelowNone(fit, k, with, covariance)) return true;
  for (const JointTerm term : {JointTerm::kViscous, JointTerm::kCoulomb}) {
    for (int j = 0; j < fit.rows().num_joints(); ++j) {
      if (std::any_of(effects.begin(), effects.end(), [&](const auto& one) {
            return one.joint == j && (one.effect->joint_term == term ||
                                      !one.effect->stand_ins.empty());
          })) {
        continue;
      }
      const double below =
          -Limits().by_chance * StddevOf(fit.baseline(), covariance, j, term);
      if (TermOf(term, with.links[j].joint) < below &&
          TermOf(term, without.links[j].joint) >= below) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace armcal
