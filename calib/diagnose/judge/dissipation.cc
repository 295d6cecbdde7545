#include "calib/diagnose/judge/dissipation.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr double kBelowZero = 3;  // standard deviations

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

}  // namespace

bool MakesFrictionGivePower(const GapFit& fit, size_t k) {
  if (fit.regression().reference() != nullptr) return false;
  const std::vector<GapCandidate>& effects = fit.refined().effects;
  const VectorXd covariance = fit.screen().BaselineCovariance().diagonal();
  const Robot with = fit.baseline().With(fit.refined().baseline);
  const Robot without = fit.baseline().With(fit.regression().BaselineGiven(
      fit.regression().TorqueOf(AllBut(effects, k))));
  for (const JointTerm term : {JointTerm::kViscous, JointTerm::kCoulomb}) {
    for (int j = 0; j < fit.rows().num_joints(); ++j) {
      if (std::any_of(effects.begin(), effects.end(), [&](const auto& one) {
            return one.joint == j && (one.effect->joint_term == term ||
                                      !one.effect->stand_ins.empty());
          })) {
        continue;
      }
      const double below =
          -kBelowZero * StddevOf(fit.baseline(), covariance, j, term);
      if (TermOf(term, with.links[j].joint) < below &&
          TermOf(term, without.links[j].joint) >= below) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace armcal
