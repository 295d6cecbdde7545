#include "calib/diagnose/candidates/law_share.h"

#include <Eigen/QR>

#include "calib/diagnose/candidates/file_fields.h"
#include "calib/diagnose/candidates/refinement.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// What one unit of each term adds to the torque of joint j along the logs,
// thinned samples x terms. Dry friction changes sign within `width`.
MatrixXd TorqueOfTerms(const GapRows& rows, int j,
                       const std::vector<JointTerm>& terms, double width) {
  const CoulombTransition transition = {CoulombTransition::Law::kVelocity,
                                        width};
  std::vector<MatrixXd> torque;
  for (const GapSegment& segment : rows.segments()) {
    const Motion& motion = segment.motion;
    MatrixXd& fine = torque.emplace_back(motion.size(), terms.size());
    for (int i = 0; i < fine.rows(); ++i) {
      const double qd = motion.qd(i, j), c = transition.C(qd, 0);
      for (int k = 0; k < fine.cols(); ++k) {
        fine(i, k) = JointTermColumn{j, terms[k], transition}.Torque(
            qd, motion.qdd(i, j), c);
      }
    }
  }
  return rows.ThinAll(torque);
}

// Where a term cannot be told along this motion (an offset where the torque's
// level drifts) the decomposition gives it nothing.
VectorXd LeastSquares(const MatrixXd& columns, const VectorXd& right) {
  return columns.completeOrthogonalDecomposition().solve(right);
}

}  // namespace

void SetLawShares(const GapBaseline& baseline, GapData* data,
                  CorrectedRobot* corrected) {
  const GapRows& rows = data->rows();
  for (CarriedEffect& effect : corrected->effects) {
    const std::vector<JointTerm>& terms = effect.found.effect->stand_ins;
    const int j = effect.found.joint;
    if (j < 0 || terms.empty() || !IsMissingInSome(effect)) continue;
    const VectorXd torque =
        EffectTorque(baseline, corrected->scale, {effect.found}, data)[j];
    if (torque.size() == 0 || rows.num_rows(j) == 0) continue;
    const VectorXd share = LeastSquares(
        rows.Whiten(j, TorqueOfTerms(rows, j, terms, corrected->width[j])),
        rows.Whiten(j, torque));
    if (share.allFinite()) effect.share = share;
  }
}

double ShareOf(const CarriedEffect& effect, JointTerm term) {
  const std::vector<JointTerm>& terms = effect.found.effect->stand_ins;
  for (Eigen::Index k = 0; k < effect.share.size(); ++k) {
    if (terms[k] == term) return effect.share[k];
  }
  return 0;
}

bool HasShare(const CarriedEffect& effect) {
  return effect.share.size() > 0 && !effect.share.isZero(0);
}

}  // namespace armcal
