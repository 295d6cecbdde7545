#include "calib/diagnose/judge/findings.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "calib/diagnose/data/estimate_deviations.h"
#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/judge/body_places.h"
#include "calib/diagnose/judge/changed_together.h"
#include "calib/diagnose/judge/claims.h"
#include "calib/diagnose/judge/contact_finding.h"
#include "calib/diagnose/judge/description.h"
#include "calib/diagnose/judge/dissipation.h"
#include "calib/diagnose/judge/joint_agreement.h"
#include "calib/diagnose/judge/shared_mean.h"
#include "model/effects/effects.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Sets what a fitted effect removes of the refit's held-out gap: all that is
// removed, with its interval, where it is the only one; else by its gain, where
// the refit leaves more than noise. Of several that only fit together, one may
// gain more than there is: it removes all of it. Their intervals are those of
// the gain, over a gap that is taken as known.
void SetShare(const GapFit& fit, const GapFigures& torque,
              const EffectGain& gain, FoundEffect* found) {
  found->gain = gain;
  if (fit.refined().effects.size() == 1) {
    found->removed_percent = torque.removed_percent;
    std::copy(torque.ci95, torque.ci95 + 2, found->ci95);
  } else if (torque.known() && torque.refit > 1) {
    const auto share = [&](double lowered) {
      return std::min(100., 100 * lowered / (torque.refit - 1));
    };
    found->removed_percent = share(gain.value);
    if (std::isnan(torque.removed_percent) || std::isnan(gain.ci95[0])) return;
    std::transform(gain.ci95, gain.ci95 + 2, found->ci95, share);
  }
}

// FoundEffect::size: the rms of the effect's torque over that of the joint's,
// on the joint where this is largest. FoundEffect::gap: what a refit leaves of
// the joint's held-out mean square.
double SizeOf(const GapFit& fit, const GapCandidate& effect) {
  double size = 0;
  const JointRows torque = fit.TorqueOf(effect);
  for (size_t j = 0; j < torque.size(); ++j) {
    if (torque[j].size() == 0) continue;
    const double rms =
        torque[j].norm() / std::sqrt(static_cast<double>(torque[j].size()));
    if (rms > 0) size = std::max(size, rms / fit.scale().torque[j]);
  }
  return size;
}
double GapWhere(const GapFigures& torque, int joint) {
  if (joint < 0 || joint >= torque.joints.rows()) return torque.refit;
  return std::pow(torque.joints(joint, 1), 2);
}

// Whether b is what a file has a number for and a's law has a mean of. (A
// spring, which a cable is near its centre, is a law of its own beside it.)
bool IsMeanOf(const FoundEffect& b, const FoundEffect& a) {
  return a.joint >= 0 && a.joint == b.joint &&
         b.effect->joint_term.has_value() && HasMean(*a.effect, *b.effect);
}

// A term of which these data tell no joint's value beside the model's others:
// it is not said to be lacking.
bool IsUntoldTerm(const FoundEffect& found) {
  return found.missing_term && found.estimates.empty();
}

// Of all joints alike. A clock is one for all; what lags differently is none.
bool HasOneSize(const GapCandidate& effect) {
  return effect.joint < 0 &&
         (effect.effect->nature == Effect::Nature::kRecording ||
          !effect.effect->if_joints_disagree.empty());
}

class Findings {
 public:
  Findings(const Robot& robot, const GapFit& fit, const HeldOut& held_out,
           const GapFigures& torque)
      : robot_(robot),
        fit_(fit),
        evidence_(fit, held_out, torque),
        torque_(torque) {}

  GapFindings List(const std::vector<MissingTerm>& terms);

 private:
  FoundEffect Describe(const GapCandidate& effect,
                       const MatrixXd& covariance) const;
  FoundEffect Found(size_t k) const;
  void AddMissingTerms(const std::vector<MissingTerm>& terms);
  bool IsTaken(const FoundEffect& mean) const;

  const Robot& robot_;
  const GapFit& fit_;
  const GapEvidence evidence_;
  const GapFigures& torque_;
  GapFindings result_;
};

FoundEffect Findings::Describe(const GapCandidate& effect,
                               const MatrixXd& covariance) const {
  FoundEffect found;
  found.effect = effect.effect;
  found.joint = effect.joint;
  DescribeFitted(fit_, effect, covariance, &found);
  return found;
}

// All that is said of the k-th effect. Others that could stand in its place are
// told where they are in the 95 % set of its place. The effect's own gap is
// known with a reference only: without one, a refit may have taken up what is
// the effect's. Two further tests are asked of what they can be asked of:
// whether joints agree, of clocks, delays and what else has one size for all
// joints; and whether it is beyond the scatter from log to log of the
// reference, of what does not swing in time, since the phase of that is of each
// log.
FoundEffect Findings::Found(size_t k) const {
  const RefinedEffects& refined = fit_.refined();
  const GapCandidate& effect = refined.effects[k];
  FoundEffect found = Describe(effect, CovarianceOf(refined, k));
  found.fitted = {static_cast<int>(k)};
  found.score = fit_.selection().scores[k];
  found.delta_chi2 = fit_.selection().delta_chi2[k];
  found.size = SizeOf(fit_, effect);
  // Without a reference a refit may have taken up what is the effect's.
  if (fit_.noise().source == NoiseFloor::kReference) {
    found.gap = GapWhere(torque_, effect.joint);
  }
  const std::vector<PlacedEffect> all = Alternatives(fit_, k);
  for (const PlacedEffect& other : CredibleSet(all)) {
    if (other.effect != found.effect || other.joint != found.joint) {
      found.equivalent.push_back(other);
    }
  }
  found.evidence = evidence_.ForEffect(k, all);
  if (HasOneSize(effect)) {
    const JointAgreement agreement = JointAgreementOn(fit_, k);
    found.joints_agree =
        !agreement.Differ(Limits().form_error) && !agreement.IsOfOneJoint();
    if (!found.joints_agree) found.joint_sizes = agreement.joints;
    WidenByJoints(fit_, effect, agreement, &found);
  }
  found.dissipates = !MakesFrictionGivePower(fit_, k);
  // What swings has a phase of its own in each log.
  if (effect.log < 0 && !SwingsInTime(*effect.effect)) {
    found.scatter = fit_.ScatterOf(effect);
    // Of its numbers a reference's model has as much as it shows.
    if (effect.effect->nature != Effect::Nature::kParameter) {
      const GapRegression& regression = fit_.regression();
      found.in_reference = regression.ShareInReference(
          effect, regression.TorqueOf(refined.effects));
    }
  }
  found.over_change = OverChangedFriction(fit_, torque_, effect.joint,
                                          found.evidence.gain.value);
  found.probability = ProbabilityOf(found.evidence);
  found.any_probability = ProbabilityOfAny(found.evidence);
  SetShare(fit_, torque_, found.evidence.gain, &found);
  found.separate_by = found.equivalent.empty() ? "" : found.effect->experiment;
  return found;
}

// What the file gives no joint at all, as one effect each. Its probability is
// 1: it was asked for with the threshold of an effect before anything else was
// fitted, and that a robot has friction is no hypothesis.
void Findings::AddMissingTerms(const std::vector<MissingTerm>& terms) {
  if (terms.empty()) return;
  const MatrixXd covariance = fit_.screen().BaselineCovariance();
  for (const MissingTerm& term : terms) {
    FoundEffect found;
    found.effect = term.effect;
    found.missing_term = term.joint_term;
    found.probability = 1;
    found.score = found.delta_chi2 = term.delta_chi2;
    DescribeMissingTerm(fit_, covariance, &found);
    if (!IsUntoldTerm(found)) result_.effects.push_back(found);
  }
}

// Whether an effect is fitted, or named, at its place already: two laws of one
// joint have one mean.
bool Findings::IsTaken(const FoundEffect& mean) const {
  const auto is_it = [&](const auto& other) {
    return other.effect == mean.effect && other.joint == mean.joint;
  };
  const std::vector<GapCandidate>& fitted = fit_.refined().effects;
  return std::any_of(fitted.begin(), fitted.end(), is_it) ||
         std::any_of(result_.effects.begin(), result_.effects.end(), is_it);
}

// Everything that was fitted is described, sorted by delta_chi2, and joined
// where a law and its mean are one thing. Then two sieves: what explains
// nothing that needs explaining (IsNeeded), and what is needed but not sure
// enough (IsClaimed). Both stand as `fitted, not named`; if the second leaves
// nothing that is claimed, and held-out data have it again, something is there
// without a name.
GapFindings Findings::List(const std::vector<MissingTerm>& terms) {
  result_.effects = ListChangedTogether(fit_);
  AddMissingTerms(terms);
  if (!fit_.events().empty()) {
    result_.effects.push_back(FindContact(robot_, fit_, evidence_.ForEvents()));
  }
  for (size_t k = 0; k < fit_.refined().effects.size(); ++k) {
    result_.effects.push_back(Found(k));
  }
  SortFindings(&result_.effects);
  JoinMeans(&result_.effects);
  for (FoundEffect& found : result_.effects) {
    ShareTheRest(&found, &result_.candidates);
    PoolPlacesOfBody(&found);
  }
  const double extra_variance = ExtraVariance(fit_.noise().source);
  const auto unneeded =
      std::stable_partition(result_.effects.begin(), result_.effects.end(),
                            [&](const FoundEffect& found) {
                              return IsNeeded(found, extra_variance);
                            });
  result_.unnamed.assign(unneeded, result_.effects.end());
  result_.effects.erase(unneeded, result_.effects.end());
  for (FoundEffect& found : result_.effects) {
    // A law that is likely by itself is not told as its mean.
    const FoundEffect shared = AsSharedMean(found);
    const bool is_itself = shared.effect == found.effect;
    const bool is_free = !IsClaimed(found) && !IsTaken(shared);
    if (IsClaimed(shared) && (is_itself || is_free)) found = shared;
  }
  const auto unclaimed = std::stable_partition(
      result_.effects.begin(), result_.effects.end(), IsClaimed);
  result_.without_name = unclaimed == result_.effects.begin() &&
                         IsThereWithoutName(result_.effects, torque_);
  result_.unnamed.insert(result_.unnamed.begin(), unclaimed,
                         result_.effects.end());
  result_.effects.erase(unclaimed, result_.effects.end());
  for (FoundEffect& found : result_.unnamed) {
    found.one_of_few = IsNeeded(found, extra_variance) && IsOneOfFew(found);
  }
  return result_;
}

}  // namespace

// By delta_chi2, largest first. What a file has a number for (the mean of a
// law) is put behind the law of which it is one where the latter explains
// form_error of it: it had taken the law's mean for its own, and would
// otherwise hide the cause behind its average.
void SortFindings(std::vector<FoundEffect>* effects) {
  std::stable_sort(effects->begin(), effects->end(),
                   [](const FoundEffect& a, const FoundEffect& b) {
                     return a.delta_chi2 > b.delta_chi2;
                   });
  for (size_t k = 1; k < effects->size(); ++k) {
    for (size_t i = k; i > 0; --i) {
      FoundEffect &before = (*effects)[i - 1], &law = (*effects)[i];
      const double least = Limits().form_error * before.delta_chi2;
      if (!IsMeanOf(before, law) || law.delta_chi2 < least) break;
      std::swap(before, law);
    }
  }
}

void JoinMeans(std::vector<FoundEffect>* effects) {
  for (size_t k = 0; k < effects->size(); ++k) {
    for (size_t i = k + 1; i < effects->size();) {
      FoundEffect& law = (*effects)[k];
      const FoundEffect& mean = (*effects)[i];
      if (!IsMeanOf(mean, law)) {
        ++i;
        continue;
      }
      law.estimates.insert(law.estimates.end(), mean.estimates.begin(),
                           mean.estimates.end());
      law.stddev.insert(law.stddev.end(), mean.stddev.begin(),
                        mean.stddev.end());
      law.stddev_by_scale.insert(law.stddev_by_scale.end(),
                                 mean.stddev_by_scale.begin(),
                                 mean.stddev_by_scale.end());
      law.fitted.insert(law.fitted.end(), mean.fitted.begin(),
                        mean.fitted.end());
      effects->erase(effects->begin() + i);
    }
  }
}

// Whether the effect or one of those in its place is there is a question of its
// own (ProbabilityOfAny). They share what this is above the effect's own as
// their scores say, and what is left is that none of the catalogue is. The set
// of candidates ends where 95 % of what is told are in it, or where each of the
// others has less than kLeastCandidate.
void ShareTheRest(FoundEffect* found, std::vector<PlacedEffect>* candidates) {
  constexpr double kLeastCandidate = .01;
  double others = 0;
  for (const PlacedEffect& other : found->equivalent) {
    others += other.probability;
  }
  double& any = found->any_probability;
  any = std::max(any, found->probability);
  const double shared = any - found->probability;
  candidates->push_back(
      {found->effect, found->joint, found->probability, found->score});
  double sum = found->probability;
  for (PlacedEffect& other : found->equivalent) {
    other.probability *= shared / std::max(1e-9, others);
    if (sum < Limits().credible * any && other.probability >= kLeastCandidate) {
      candidates->push_back(other);
    }
    sum += other.probability;
  }
}

GapFindings ListFindings(const Robot& robot, const GapFit& fit,
                         const HeldOut& held_out, const GapFigures& torque,
                         const std::vector<MissingTerm>& terms) {
  return Findings(robot, fit, held_out, torque).List(terms);
}

// Effects that are not claimed leave the fit, and everything that is shown is
// of the fit without them: estimates, covariances and, later, the figures. What
// they explained may go to the others, which is why these are described anew,
// and what has changed together with them.
bool FitClaimed(GapFindings* findings, GapFit* fit) {
  std::vector<int> kept;
  for (const FoundEffect& found : findings->effects) {
    kept.insert(kept.end(), found.fitted.begin(), found.fitted.end());
  }
  const bool is_another = PutMeansInPlace(findings->effects, fit);
  if (kept.size() == fit->refined().effects.size() && !is_another) return false;
  std::sort(kept.begin(), kept.end());
  fit->KeepOnly(kept);
  std::vector<FoundEffect>& effects = findings->effects;
  effects.erase(std::remove_if(effects.begin(), effects.end(),
                               [](const FoundEffect& found) {
                                 return found.of_another_day;
                               }),
                effects.end());
  for (FoundEffect& found : ListChangedTogether(*fit)) {
    effects.push_back(std::move(found));
  }
  SortFindings(&effects);
  std::optional<MatrixXd> covariance;  // of the baseline
  for (FoundEffect& found : findings->effects) {
    if (found.fitted.empty() && !found.missing_term) continue;
    found.estimates.clear();
    found.stddev.clear();
    found.stddev_by_scale.clear();
    if (found.missing_term) {
      if (!covariance) covariance = fit->screen().BaselineCovariance();
      DescribeMissingTerm(*fit, *covariance, &found);
    }
    for (int& k : found.fitted) {
      k = static_cast<int>(std::lower_bound(kept.begin(), kept.end(), k) -
                           kept.begin());
      const GapCandidate& effect = fit->refined().effects[k];
      DescribeFitted(*fit, effect, CovarianceOf(fit->refined(), k), &found);
      if (HasOneSize(effect)) {
        WidenByJoints(*fit, effect, JointAgreementOn(*fit, k), &found);
      }
    }
  }
  effects.erase(std::remove_if(effects.begin(), effects.end(), IsUntoldTerm),
                effects.end());
  return true;
}

void SetClaimedShares(const GapFit& fit, const HeldOut& held_out,
                      const GapFigures& torque,
                      std::vector<FoundEffect>* effects) {
  for (FoundEffect& found : *effects) {
    if (found.fitted.empty() || !torque.known()) continue;
    SetShare(fit, torque, held_out.GainOf(found.fitted[0]), &found);
  }
}

}  // namespace armcal
