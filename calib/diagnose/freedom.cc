#include "calib/diagnose/freedom.h"

#include <cmath>
#include <vector>

#include "calib/diagnose/select/chosen.h"
#include "calib/diagnose/select/evidence_noise.h"

namespace armcal {
namespace {

MissingTerm* Find(JointTerm term, MissingTerms* missing) {
  for (MissingTerm& one : missing->terms) {
    if (one.joint_term == term) return &one;
  }
  return nullptr;
}

}  // namespace

// A joint's term keeps 1e-6 of its usual size, as where logs ask for none
// (FitMissingTerms), and no column.
bool HoldNegative(const GapFit& fit, MissingTerms* missing) {
  const GapBaseline& baseline = fit.baseline();
  const Robot robot = baseline.With(fit.model_after());
  const Eigen::VectorXd variance = fit.screen().BaselineCovariance().diagonal();
  bool any = false;
  for (int c = 0; c < baseline.size(); ++c) {
    const BaselineColumn& column = baseline.columns()[c];
    if (column.kind != BaselineColumn::Kind::kTerm) continue;
    MissingTerm* term = Find(static_cast<JointTerm>(column.index), missing);
    const int j = column.joint;
    if (term == nullptr || term->joint_term == JointTerm::kOffset) continue;
    const double deviation = column.spread * std::sqrt(variance[c]);
    if (TermOf(term->joint_term, robot.links[j].joint) >= -deviation) continue;
    *TermOf(term->joint_term, &missing->robot.links[j].joint) =
        1e-6 * term->usual[j];
    term->value[j] = term->usual[j] = 0;
    any = true;
  }
  return any;
}

// By half decades, from the 5 % of a file taken at its word to the 50 % that
// calibrations give one.
double LikeliestTrust(const GapFit& fit) {
  // Torques that were reconstructed keep the noise of their positions.
  if (!fit.rows().has_evidence()) return 1;
  const GapBaseline& baseline = fit.baseline();
  std::vector<int> inertial;
  for (int c = 0; c < baseline.size(); ++c) {
    const bool is_inertial =
        baseline.columns()[c].kind == BaselineColumn::Kind::kInertial;
    if (is_inertial) inertial.push_back(c);
  }
  const GapScreen chosen =
      fit.screen().Only(ColumnsOf(fit.candidates(), fit.selection().chosen));
  return LikeliestScale(chosen, fit.regression().evidence(), inertial,
                        {1, 3, 10});
}

}  // namespace armcal
