#include "calib/gap_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace armcal {
namespace {

// Of ProbabilityOf: logistic regression on the 161 effects found in cases of
// the blind bench's calibration seeds 301 and 302, with a ridge towards the
// regression on 49 of them that came before.
constexpr double kConstant = -.947, kOdds = .418, kStrength = .249,
                 kLeft = -1.692, kHeldOutLeft = -.795, kNext = -.0334,
                 kChosen = -1.035, kShare = -.0392, kEvent = -1.625,
                 kEvents = -.2515, kOneJoint = -1.137, kGain = 5.943;

}  // namespace

double Excess(const GapFit& fit, int joint, bool with_effects) {
  const Eigen::VectorXd residual =
      with_effects ? fit.Left(joint) : fit.screen().Residual(joint, {});
  const GapNoise& noise = fit.noise();
  const double doubt = VarianceDoubt(noise.source) +
                       (noise.doubt.empty() ? 0 : noise.doubt[joint]);
  return std::max(0., residual.squaredNorm() - (1 + doubt) * residual.size());
}

namespace {

constexpr double kMostOdds = 12;

double SumOfDrops(const GapFit& fit) {
  double sum = 0;
  for (const double drop : fit.selection().drops) sum += drop;
  for (const GapEvent& event : fit.events()) sum += event.drop;
  return sum;
}

// What is said of all that was chosen.
EffectEvidence Common(const GapFit& fit, const GapFigures& figures) {
  EffectEvidence evidence;
  evidence.chosen =
      static_cast<int>(fit.selection().drops.size()) + !fit.events().empty();
  double left = 0;
  for (int j = 0; j < fit.rows().num_joints(); ++j) {
    left += Excess(fit, j, true);
  }
  evidence.left = left / std::max(1., left + SumOfDrops(fit));
  evidence.held_out_left =
      std::max(0., figures.after - 1.1) / std::max(.1, figures.refit - 1);
  evidence.next = std::max(
      0., ScoresBeside(fit.screen(), fit.candidates(), fit.selection_options(),
                       fit.selection().chosen, -1)
              .maxCoeff());
  return evidence;
}

}  // namespace

EffectEvidence EvidenceFor(const GapFit& fit, const HeldOut& held_out,
                           const GapFigures& figures, size_t k,
                           const std::vector<PlacedEffect>& all) {
  EffectEvidence evidence = Common(fit, figures);
  const GapCandidate& effect = fit.refined().effects[k];
  double others = -std::numeric_limits<double>::infinity(), own = others;
  for (const PlacedEffect& other : all) {
    const bool same =
        other.effect == effect.effect && other.joint == effect.joint;
    (same ? own : others) = std::max(same ? own : others, other.score);
  }
  const double drop = fit.selection().drops[k];
  evidence.odds =
      std::clamp((own - others) / (2 * kTemperature), -kMostOdds, kMostOdds);
  evidence.strength = std::log(std::max(1., drop));
  evidence.share = drop / SumOfDrops(fit);
  evidence.gain = held_out.Gain(k, figures.after);
  return evidence;
}

EffectEvidence EvidenceForEvents(const GapFit& fit, const GapFigures& figures) {
  EffectEvidence evidence = Common(fit, figures);
  double drop = 0, most = 0;
  for (const GapEvent& event : fit.events()) {
    drop += event.drop;
    if (event.drop <= most) continue;
    most = event.drop;
    evidence.one_joint = event.one_joint;
  }
  evidence.odds = kMostOdds;
  evidence.strength = std::log(std::max(1., drop));
  evidence.share = drop / SumOfDrops(fit);
  evidence.events = static_cast<int>(fit.events().size());
  return evidence;
}

double ProbabilityOf(const EffectEvidence& e) {
  const bool comes_and_goes = e.events > 0;
  const double sum =
      kConstant + kOdds * std::clamp(e.odds, -1., 8.) +
      kStrength * std::min(e.strength, 9.) + kLeft * e.left +
      kHeldOutLeft * std::min(e.held_out_left, 1.5) +
      kNext * std::min(e.next, 100.) + kChosen * (e.chosen - 1) +
      kShare * std::log(std::max(e.share, 1e-4)) +
      (comes_and_goes ? kEvent + kEvents * std::min(e.events, 8) +
                            kOneJoint * std::min(e.one_joint, 1.5)
                      : kGain * std::clamp(e.gain, -.1, .3));
  return 1 / (1 + std::exp(-sum));
}

}  // namespace armcal
