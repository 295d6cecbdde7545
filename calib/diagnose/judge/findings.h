#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "calib/diagnose/judge/evidence.h"
#include "calib/diagnose/judge/held_out.h"
#include "calib/diagnose/judge/probability.h"
#include "calib/diagnose/judge/removed_share.h"
#include "calib/diagnose/select/contacts.h"
#include "calib/diagnose/select/families.h"
#include "calib/diagnose/select/fit.h"

namespace armcal {

// One effect that was found.
struct FoundEffect {
  const Effect* effect = nullptr;
  int joint = -1;  // from 0; -1: all joints or the whole robot
  double probability = 0;
  double score = 0;
  double drop = 0;  // of chi^2 when it is left out
  EffectEvidence evidence;
  // Which of the fit's effects it is of: one, or a law and then its mean; none
  // of what is no effect of the fit's.
  std::vector<int> fitted;
  std::vector<EffectEstimate> estimates;
  std::vector<double> stddev;  // of the estimates
  // rms of its torque over the joint's usual one, on the joint where that is
  // most.
  double size = std::numeric_limits<double>::infinity();
  // What a refit without it leaves of held-out data where it acts, mean square
  // over the noise's; NaN where nothing was held out.
  double gap = std::numeric_limits<double>::quiet_NaN();
  // Others that these data cannot tell from it.
  std::vector<PlacedEffect> equivalent;
  // Of the held-out gap, by this one beside the others; NaN: not known.
  double removed_percent = NAN;
  double ci95[2] = {NAN, NAN};
  std::string separate_by;        // the experiment that would tell them apart
  std::vector<Contact> contacts;  // of external_contact, in time's order
  // Whether joints tell it alike, if it is of all of them.
  bool joints_agree = true;
  // Whether it is friction of several joints that is that of another day: one
  // change, the estimates being each joint's, and no term of the model's.
  bool of_another_day = false;
};

// Likelier than not.
bool IsLikely(const FoundEffect& found);

// Whether there is anything for it to explain: a refit without it leaves no
// less than the noise, as well as that is known, and its torque is not smaller
// than what the best of models lack.
bool IsNeeded(const FoundEffect& found, double variance_doubt);

// Whether held-out data have it as well, in part.
bool IsSeenAgain(const FoundEffect& found);

// Whether something is there though none of its effects is claimed: held-out
// data have one of them as well, and it does not only mend what others spoiled.
bool IsThereWithoutName(const std::vector<FoundEffect>& effects,
                        const GapFigures& held_out);

// Whether such a thing can be: a load is held by the tool.
bool IsPossible(const FoundEffect& found);

// Whether held-out data should show it, and have neither chi^2 nor the mean
// square lower with it. A form that is a little too large raises chi^2 alone;
// and what is small beside what it explained where it was fitted may be what
// its form has wrong.
bool IsContradicted(const FoundEffect& found);

// Whether it is told as an effect; what is not is a candidate. It has to be
// possible and likelier than not, or likely enough and of help on held-out
// data, as what swings in time has to be anyway; what held-out data do not show
// has to be likelier.
bool IsClaimed(const FoundEffect& found);

// By their drops, but for what the file has a number for: that may take the
// mean of a law on the same joint for its own, more than it leaves of the law,
// and comes after it.
void SortFindings(std::vector<FoundEffect>* effects);
// Such a mean that comes after its law is one effect with it, among whose
// estimates it is.
void JoinMeans(std::vector<FoundEffect>* effects);

// What a fit found.
struct GapFindings {
  // Probable enough to be claimed, what is likelier than not first, each
  // strongest first.
  std::vector<FoundEffect> effects;
  // Fitted as well, but not probable enough to be claimed.
  std::vector<FoundEffect> unnamed;
  // Those and all others that may be in their places: 95 % of each.
  std::vector<PlacedEffect> candidates;
  // Something was found, and seen again on held-out data, that no name is
  // probable enough for.
  bool without_name = false;
};

// `families`: what the file gives no joint at all; empty where that is nothing
// new.
GapFindings ListFindings(const Robot& robot, const GapFit& fit,
                         const HeldOut& held_out, const GapFigures& torque,
                         const std::vector<LackedFamily>& families);

// Keeps the claimed effects alone in the fit, and tells them as they are then;
// what they remove is told by SetClaimedShares, once the figures are known.
void FitClaimed(GapFindings* findings, GapFit* fit);
// Does not claim the effect that removes least. Whether there was one.
bool GiveUpWorst(GapFindings* findings);
void SetClaimedShares(const GapFit& fit, const HeldOut& held_out,
                      const GapFigures& torque,
                      std::vector<FoundEffect>* effects);

}  // namespace armcal
