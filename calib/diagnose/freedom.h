#pragma once

#include "calib/diagnose/select/fit.h"
#include "calib/diagnose/select/missing_terms.h"

namespace armcal {

// How far a robot file's numbers may be off, once effects have been chosen: two
// assumptions that these contradict, and with which they are chosen anew.

// Of the joint terms that the file gives no joint, those that come out below 0
// by more than a standard deviation beside the chosen effects are held at 0:
// friction gives no power, and a motor's inertia is none to be had back. What
// asks for it is something else, such as a link lighter than in the file.
// Whether there was any.
bool HoldNegative(const GapFit& fit, MissingTerms* missing);

// By which of the factors 1, 3 and 10 the trust in the file's inertial
// parameters (their relative standard deviations) is larger than was assumed:
// the one under which the logs are the likeliest, the chosen effects among the
// parameters, all integrated over. Where one effect explains what a file lacks,
// its one column costs less than all links' freedom; where the file is rough
// throughout no single effect does (type II maximum likelihood, MacKay 1992).
double LikeliestTrust(const GapFit& fit);

}  // namespace armcal
