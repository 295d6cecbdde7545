#pragma once

#include <vector>

#include "calib/diagnose/judge/found_effect.h"
#include "calib/diagnose/judge/held_out.h"
#include "calib/diagnose/judge/removed_share.h"
#include "calib/diagnose/select/fit.h"
#include "calib/diagnose/select/missing_terms.h"
#include "model/robot/robot.h"

namespace armcal {

// By delta chi^2, but for what the file has a number for: that may take the
// mean of a law on the same joint for its own, more than it leaves of the law,
// and comes after it.
void SortFindings(std::vector<FoundEffect>* effects);
// Such a mean that comes after its law is one effect with it, among whose
// estimates it is.
void JoinMeans(std::vector<FoundEffect>* effects);

// Shares what `any_probability` is above the effect's own among its
// equivalents, whose probabilities are those of a softmax before. Both are
// candidates then, up to 95 % of `any_probability`, but for those below 1 %.
void ShareTheRest(FoundEffect* found, std::vector<PlacedEffect>* candidates);

// What a fit found.
struct GapFindings {
  // Probable enough to be claimed, the strongest first.
  std::vector<FoundEffect> effects;
  // Fitted as well, but not probable enough to be claimed.
  std::vector<FoundEffect> unnamed;
  // Those and all others that may be in their places: 95 % of each.
  std::vector<PlacedEffect> candidates;
  // Something was found, and seen again on held-out data, that no name is
  // probable enough for.
  bool without_name = false;
};

// `terms`: what the file gives no joint at all; empty where that is nothing
// new.
GapFindings ListFindings(const Robot& robot, const GapFit& fit,
                         const HeldOut& held_out, const GapFigures& torque,
                         const std::vector<MissingTerm>& terms);

// Keeps the claimed effects alone in the fit, and tells them as they are then;
// what they remove is told by SetClaimedShares, once the figures are known.
// Whether the fit is another one.
bool FitClaimed(GapFindings* findings, GapFit* fit);
void SetClaimedShares(const GapFit& fit, const HeldOut& held_out,
                      const GapFigures& torque,
                      std::vector<FoundEffect>* effects);

}  // namespace armcal
