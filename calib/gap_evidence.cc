#include "calib/gap_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace armcal {
namespace {

constexpr double kTolerance = .25;  // of the noise's variance

GapScreen::Fit EffectsOf(const GapFit& fit) {
  return fit.screen().Solve(
      ColumnsOf(fit.candidates(), fit.selection().chosen));
}

}  // namespace

double Excess(const GapFit& fit, int joint, bool with_effects) {
  const Eigen::VectorXd residual = fit.screen().Residual(
      joint, with_effects ? EffectsOf(fit) : GapScreen::Fit());
  return std::max(0.,
                  residual.squaredNorm() - (1 + kTolerance) * residual.size());
}

EffectEvidence EvidenceFor(const GapFit& fit, const HeldOut& held_out,
                           const GapFigures& figures, size_t k,
                           const std::vector<PlacedEffect>& all) {
  constexpr double kMostOdds = 12;
  EffectEvidence evidence;
  const GapCandidate& effect = fit.refined().effects[k];
  double others = -std::numeric_limits<double>::infinity(), own = others;
  for (const PlacedEffect& other : all) {
    const bool same =
        other.effect == effect.effect && other.joint == effect.joint;
    (same ? own : others) = std::max(same ? own : others, other.score);
  }
  evidence.odds =
      std::clamp((own - others) / (2 * kTemperature), -kMostOdds, kMostOdds);
  const std::vector<double>& drops = fit.selection().drops;
  evidence.strength = std::log(std::max(1., drops[k]));
  evidence.share = drops[k] / std::accumulate(drops.begin(), drops.end(), 0.);
  evidence.chosen = static_cast<int>(drops.size());
  double left = 0;
  for (int j = 0; j < fit.rows().num_joints(); ++j) {
    left += Excess(fit, j, true);
  }
  evidence.left = left / (left + EffectsOf(fit).drop);
  evidence.held_out_left =
      std::max(0., figures.after - 1.1) / std::max(.1, figures.refit - 1);
  evidence.next = std::max(
      0., ScoresBeside(fit.screen(), fit.candidates(), fit.selection_options(),
                       fit.selection().chosen, -1)
              .maxCoeff());
  evidence.gain = held_out.Gain(k, figures.after);
  return evidence;
}

}  // namespace armcal
