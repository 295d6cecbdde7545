#pragma once

#include <vector>

#include "calib/gap_fit.h"
#include "calib/gap_held_out.h"
#include "calib/gap_probability.h"
#include "calib/gap_shrink.h"

namespace armcal {

// What speaks for an effect besides its score, and against the catalogue.
struct EffectEvidence {
  double odds = 0;           // ln of its softmax probability against the next
  double strength = 0;       // ln of its drop of chi^2
  double share = 1;          // of the drops of all that were chosen
  int chosen = 1;            // how many were
  double left = 0;           // share of the excess that all leave, in sample
  double held_out_left = 0;  // the same on what was held out
  double next = 0;           // score of the best further candidate, at least 0
  int events = 0;            // windows of it, of what comes and goes
  double one_joint = 0;      // GapEvent's, of the strongest
  double gain = 0;           // by how much it lowers the held-out mean square
};

// Of the k-th effect of the fit, `all` that could stand in its place.
EffectEvidence EvidenceFor(const GapFit& fit, const HeldOut& held_out,
                           const GapFigures& figures, size_t k,
                           const std::vector<PlacedEffect>& all);

// Of all events together, as one effect.
EffectEvidence EvidenceForEvents(const GapFit& fit, const GapFigures& figures);

// The probability that the effect is the one, and the joint: a logistic
// regression on evidence, fitted to which effects were right in the calibration
// cases of the blind bench (tests/blind/EVALUATIONS.md says which).
double ProbabilityOf(const EffectEvidence& evidence);

// chi^2 of joint j beyond the noise's that the fit's effects leave, or with
// none of them. How well the noise is known, its source tells.
double Excess(const GapFit& fit, int joint, bool with_effects);

}  // namespace armcal
