#include "calib/diagnose/judge/dissipation.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr double kBelowZero = 3;  // standard deviations

// A friction term of a joint and how well the baseline knows it, in the term's
// unit.
struct Friction {
  double value, stddev;
  bool GivesPower() const { return value < -kBelowZero * stddev; }
};

Friction FrictionAt(const GapFit& fit, const VectorXd& covariance,
                    const VectorXd& x, int joint, JointTerm term) {
  double variance = 0;
  const auto& columns = fit.baseline().columns();
  for (size_t c = 0; c < columns.size(); ++c) {
    const BaselineColumn& column = columns[c];
    const bool is_term = column.kind == BaselineColumn::Kind::kTerm ||
                         column.kind == BaselineColumn::Kind::kDay;
    if (!is_term || column.joint != joint) continue;
    if (static_cast<JointTerm>(column.index) != term) continue;
    variance += column.spread * column.spread * covariance[c];
  }
  const Robot robot = fit.baseline().With(x);
  return {TermOf(term, robot.links[joint].joint), std::sqrt(variance)};
}

}  // namespace

// Joints on which a fitted effect is friction as well are left out: a term
// below 0 is a part of it there. So is all that a reference tells, whose laws
// hold friction too.
bool MakesFrictionGivePower(const GapFit& fit, size_t k) {
  if (fit.regression().reference() != nullptr) return false;
  const std::vector<GapCandidate>& effects = fit.refined().effects;
  const VectorXd covariance = fit.screen().BaselineCovariance().diagonal();
  const VectorXd with = fit.refined().baseline;
  const VectorXd without = fit.regression().BaselineGiven(
      fit.regression().TorqueOf(AllBut(effects, k)));
  for (const JointTerm term : {JointTerm::kViscous, JointTerm::kCoulomb}) {
    for (int j = 0; j < fit.rows().num_joints(); ++j) {
      if (std::any_of(effects.begin(), effects.end(), [&](const auto& one) {
            return one.joint == j && (one.effect->joint_term == term ||
                                      !one.effect->stand_ins.empty());
          })) {
        continue;
      }
      if (FrictionAt(fit, covariance, with, j, term).GivesPower() &&
          !FrictionAt(fit, covariance, without, j, term).GivesPower()) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace armcal
