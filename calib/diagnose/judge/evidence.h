#pragma once

#include <vector>

#include "calib/diagnose/judge/held_out.h"
#include "calib/diagnose/judge/probability.h"
#include "calib/diagnose/judge/removed_share.h"
#include "calib/diagnose/select/fit.h"

namespace armcal {

// What speaks for an effect besides its score, and against it.
struct EffectEvidence {
  double odds = 0;  // ln of its softmax probability against the next
  // The same of it and all that data cannot tell from it, together, and its
  // share of their probability.
  double odds_of_any = 0, share_of_any = 1;
  double strength = 0;  // ln of its delta chi^2
  int chosen = 1;       // how many effects were, all events being one
  // How many of the others are stronger, and of these on its joint (if it has
  // one), a law and its mean being one, where the robot has several: what the
  // form of a strong effect has wrong looks like weaker ones, not the other way
  // round.
  int stronger = 0, stronger_beside = 0;
  double next = 0;       // score of the best further candidate, at least 0
  int events = 0;        // windows of it, of what comes and goes
  double one_joint = 0;  // GapEvent's, of the strongest
  EffectGain gain;
  bool since_reference = false;  // whether it is a change since one
  bool held_out = false;         // whether there are held-out data
  Confirmation confirmation;     // by them
  double least_share = 0;        // LeastShare of their parts
  // Whether the interval of the share of the held-out gap that it removes is
  // above 0, where it is alone: what is large may do so though chi^2 (that
  // leaves the baseline free) hardly changes.
  bool removes_gap = false;

  // Whether held-out data tell of it at all.
  bool IsTold() const { return confirmation.IsTold() || removes_gap; }
};

// The evidence for what a fit chose. Keeps references.
class GapEvidence {
 public:
  GapEvidence(const GapFit& fit, const HeldOut& held_out,
              const GapFigures& figures);

  // For its k-th effect, `all` that could stand in its place.
  EffectEvidence ForEffect(size_t k,
                           const std::vector<PlacedEffect>& all) const;
  // For all events together, as one effect.
  EffectEvidence ForEvents() const;

 private:
  // Whether the i-th effect is on the joint of the k-th, the two not being a
  // law and its mean.
  bool IsBeside(size_t i, size_t k) const;

  const GapFit& fit_;
  const HeldOut& held_out_;
  const GapFigures& figures_;
  EffectEvidence common_;  // what is said of all
};

// The probability that the effect is the one, and the joint: a logistic
// regression on evidence, fitted to which effects were right in the calibration
// cases of the blind bench (tests/blind/EVALUATIONS.md says which). No more
// than its share of the probability that it or one of those that the data
// cannot tell from it is there.
double ProbabilityOf(const EffectEvidence& evidence);
// That it is this one or one of those that the data cannot tell from it: the
// same regression on the evidence for all of them as if they were one.
double ProbabilityOfAny(const EffectEvidence& evidence);

// The same of contacts that stand out from friction and from a single
// reference, which does not tell how much logs differ: by how much each of them
// lowers chi^2 and how much of that one joint alone explains, since a touch is
// felt by several and what a joint has wrong by itself.
double ProbabilityBeyondOneReference(const EffectEvidence& evidence);

// chi^2 of joint j beyond the noise's that the fit's effects leave, or with
// none of them. How well the noise is known, its source tells.
double Excess(const GapFit& fit, int joint, bool with_effects);

}  // namespace armcal
