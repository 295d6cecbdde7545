#include "calib/diagnose/judge/claims.h"

#include <algorithm>
#include <cmath>

#include "calib/diagnose/data/thresholds.h"
#include "model/effects/effects.h"

namespace armcal {
namespace {

// Whether a touch has a size: of one that may as well push the other way, as
// one-sided 95 % have it, nothing is known. Of a joint at rest, whose friction
// may hold anything, the deviation is sqrt(1/3) of the room that is left, and
// a touch that is felt is beyond all of it.
bool IsSizeTold(const FoundEffect& found) {
  constexpr double kNormal95 = 1.645;
  return std::abs(found.estimates[0].value) > kNormal95 * found.stddev[0];
}

// Whether touches are fewer than what they stand out from: a joint's model is
// known by its motion without them, and where that is the lesser part of the
// logs, the model is wrong instead (no estimate resists more than half of its
// samples: Donoho and Huber 1983).
bool IsAnEvent(const FoundEffect& found) {
  constexpr double kBreakdown = .5;
  return found.share_of_time < kBreakdown;
}

// Whether it is told as an effect where it has this probability.
bool IsClaimedAt(const FoundEffect& found, double probability) {
  if (!found.is_possible || found.of_idle_drive) return false;
  if (found.of_motions_line) return false;
  if (IsContradicted(found) || !HasANumber(found)) return false;
  if (!found.joints_agree || !found.dissipates) return false;
  if (!IsBeyondScatter(found)) return false;
  // What the reference is likelier to have as well than not, though that law
  // was not told of it, is no change.
  if (found.in_reference.IsTold() && found.in_reference.odds() > 0)
    return false;
  // At a frequency that other data do not have, it was a random torque.
  if (SwingsInTime(*found.effect) && found.evidence.gain.value <= 0)
    return false;
  // Where a refit without it leaves no more than the noise, nothing asks for
  // it. (NaN: no reference tells.)
  const bool is_shown = IsSeenAgain(found) && !(found.gap <= 1);
  return probability >= (is_shown ? Limits().likely : Limits().likely_unseen);
}

}  // namespace

bool HasANumber(const FoundEffect& found) {
  constexpr double kNormal975 = 1.96;
  if (found.stddev_by_scale.empty()) return true;
  bool is_fitted = false;  // one has a deviation at least
  for (size_t i = 0; i < found.stddev_by_scale.size(); ++i) {
    const double stddev = found.stddev_by_scale[i];
    if (!(stddev > 0)) continue;  // nothing tells of it, or it is given
    is_fitted = true;
    if (std::abs(found.estimates[i].value) > kNormal975 * stddev) return true;
  }
  return !is_fitted;
}

bool IsNeeded(const FoundEffect& found, double extra_variance) {
  const bool has_gap = !(found.gap < 1 - extra_variance);
  const bool is_seen = IsSeenAgain(found) && !SwingsInTime(*found.effect);
  const bool is_form_of_change = found.over_change < Limits().same_joint_share;
  return (has_gap || is_seen) && !is_form_of_change &&
         found.size >= Limits().least_discrepancy * Limits().discrepancy;
}

bool IsBeyondScatter(const FoundEffect& found) {
  return found.scatter.IsBeyond(Limits().chance_quantile);
}

bool IsSeenAgain(const FoundEffect& found) {
  const Confirmation& confirmation = found.evidence.confirmation;
  return confirmation.IsTold() ? confirmation.Share() > Limits().seen_again
                               : found.evidence.removes_gap;
}

bool IsThereWithoutName(const std::vector<FoundEffect>& effects,
                        const GapFigures& held_out) {
  return held_out.after < held_out.refit &&
         std::any_of(effects.begin(), effects.end(), [](const auto& found) {
           // What shrinks for certain is there, though parts of the log may
           // give it other names.
           const bool shrinks = found.evidence.gain.ci95[0] > 0;
           return (IsSeenAgain(found) || shrinks) && IsBeyondScatter(found);
         });
}

bool IsContradicted(const FoundEffect& found) {
  const Confirmation& confirmation = found.evidence.confirmation;
  return confirmation.expected >
             std::max(Limits().visible,
                      Limits().form_error * found.delta_chi2) &&
         confirmation.explained < 0 && !(found.evidence.gain.ci95[0] > 0);
}

bool IsClaimed(const FoundEffect& found) {
  if (found.of_another_day) return true;
  if (!found.contacts.empty()) {
    return found.probability >= Limits().likely && IsSizeTold(found) &&
           IsAnEvent(found);
  }
  return IsClaimedAt(found, found.probability);
}

bool IsOneOfFew(const FoundEffect& found) {
  const size_t members = 1 + found.equivalent.size();
  return !found.fitted.empty() && members > 1 &&
         static_cast<double>(members) <= Limits().few &&
         IsClaimedAt(found, found.any_probability);
}

}  // namespace armcal
