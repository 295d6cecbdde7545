#include "calib/diagnose/judge/changed_together.h"

#include <cmath>
#include <limits>

#include "calib/diagnose/data/days.h"
#include "calib/diagnose/data/estimate_deviations.h"
#include "calib/diagnose/data/thresholds.h"
#include "model/effects/effects.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Columns of friction are in units of the usual scatter from day to day, so
// that the sum of their squares is chi squared of that many changes. Zeros are
// free only where the evidence was for it (HaveZerosMoved).
std::vector<FoundEffect> ListChangedTogether(const GapFit& fit) {
  std::vector<FoundEffect> all;
  const GapBaseline& baseline = fit.baseline();
  const VectorXd& x = fit.refined().baseline;
  const MatrixXd covariance = fit.screen().BaselineCovariance();
  for (const Effect& effect : Effects()) {
    if (!effect.joint_term) continue;
    const std::vector<int> changed =
        *effect.joint_term == JointTerm::kOffset
            ? NotableZeros(baseline, x)
            : ChangedTogether(baseline, *effect.joint_term, x, covariance);
    if (changed.empty()) continue;
    FoundEffect found;
    found.effect = &effect;
    found.of_another_day = true;
    found.probability = 1 - ChanceBeyond();
    for (const int c : changed) {
      const BaselineColumn& column = baseline.columns()[c];
      const Joint& joint = baseline.robot().links[column.joint].joint;
      found.estimates.push_back(
          {joint.name + "." + JointTermName(*effect.joint_term),
           JointTermUnit(*effect.joint_term, joint.type),
           x[c] * column.spread});
      const EffectEstimate& term = found.estimates.back();
      found.stddev.push_back(WithTorqueScale(
          std::sqrt(covariance(c, c)) * column.spread, term.value, term.unit,
          baseline.discrepancy().torque_constants_stddev()));
      found.delta_chi2 += x[c] * x[c];
    }
    found.score = found.delta_chi2;
    all.push_back(found);
  }
  return all;
}

// FoundEffect::over_change: friction as it has changed given no effects. What
// an effect on one joint lowers of the mean of all joints, it lowers as many
// times of its own.
double OverChangedFriction(const GapFit& fit, const GapFigures& torque,
                           int joint, double gain) {
  constexpr double kUnchanged = std::numeric_limits<double>::quiet_NaN();
  const GapBaseline& baseline = fit.baseline();
  if (joint < 0 || torque.joints.rows() == 0) return kUnchanged;
  if (DayColumns(baseline).empty()) return kUnchanged;
  const MatrixXd covariance = fit.screen().BaselineCovariance();
  bool has_changed = false;
  for (const JointTerm term : {JointTerm::kViscous, JointTerm::kCoulomb}) {
    for (const int c :
         ChangedTogether(baseline, term, fit.refit(), covariance)) {
      has_changed |= baseline.columns()[c].joint == joint;
    }
  }
  const double before = std::pow(torque.joints(joint, 0), 2);
  const double after = std::pow(torque.joints(joint, 1), 2);
  if (!has_changed || !(before > after)) return kUnchanged;
  return gain * fit.rows().num_joints() / (before - after);
}

}  // namespace armcal
