#include "calib/diagnose/candidates/effect_odds.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "calib/diagnose/candidates/effect_torques.h"
#include "calib/diagnose/data/thresholds.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<JointRows> LateFriction(const GapBaseline& baseline,
                                    const GapData& data) {
  const GapRows& rows = data.rows();
  std::vector<JointRows> late;
  for (int j = 0; j < rows.num_joints(); ++j) {
    const double coulomb = baseline.robot().links[j].joint.coulomb;
    if (coulomb <= 0) continue;
    JointRows thin(rows.num_joints());
    thin[j] = VectorXd::Zero(rows.num_thin());
    for (size_t i = 0; i < rows.segments().size(); ++i) {
      const int s = static_cast<int>(i);
      const VectorXd fine =
          coulomb * baseline.LateReversals(j, data.torques()[i]);
      const MatrixXd low = rows.Thin(s, {&fine});
      thin[j].segment(rows.thin_begin(s), low.rows()) = low.col(0);
    }
    late.push_back(WhitenEach(rows, thin));
  }
  return late;
}

namespace {

// Whether a share that is off by this much is so by chance, or by what a law
// may have wrong in its form.
bool IsWithinErrors(double missing_share, double delta_chi2) {
  return missing_share * missing_share * delta_chi2 <
         std::max(std::pow(Limits().by_chance, 2),
                  Limits().form_error * delta_chi2);
}

}  // namespace

bool ShareOfEffect::IsOfThisSize() const {
  return IsWithinErrors(1 - share, delta_chi2);
}

bool ShareOfEffect::IsTold() const {
  return delta_chi2 > std::pow(Limits().by_chance, 2);
}

bool ShareOfEffect::CouldBeLost() const {
  return share < -1 || IsWithinErrors(1 + share, delta_chi2);
}

double ShareOfEffect::odds() const {
  const double odds = (2 * share - 1) * delta_chi2;
  return IsOfThisSize() ? odds : std::min(0., odds);
}

// With c the effect's torque and r what is left of the logs, both whitened and
// less what is free absorbs of them, the size that fits best is c' r / c' c of
// the effect's, and the effect at its own lowers chi squared by
//   |r|^2 - |r - c|^2 = 2 c' r - c' c.
// Beside an effect that moves the time of reversals, friction's own time is
// free, which may be its joint's alone.
ShareOfEffect ShareIn(const GapBaseline& baseline, const MotionScale& scale,
                      const GapCandidate& effect, GapScreen screen,
                      GapData* data) {
  screen.AddColumn(
      WhitenEach(data->rows(), EffectTorque(baseline, scale, {effect}, data)));
  if (effect.effect->moves_reversals) {
    for (JointRows& rows : LateFriction(baseline, *data)) {
      screen.AddColumn(std::move(rows));
    }
  }
  screen.Factor();
  const MatrixXd& G = screen.G();
  const Eigen::Index late = G.cols() - 1;
  double own = G(0, 0), by_target = screen.g()[0];
  if (late > 0) {
    MatrixXd information = G.bottomRightCorner(late, late);
    for (Eigen::Index k = 0; k < late; ++k) {
      information(k, k) += screen.ridge(static_cast<int>(k + 1));
    }
    const VectorXd with = information.llt().solve(G.col(0).tail(late));
    own -= with.dot(G.col(0).tail(late));
    by_target -= with.dot(screen.g().tail(late));
  }
  return {own > 0 ? by_target / own : 0, own};
}

}  // namespace armcal
