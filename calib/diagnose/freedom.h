#pragma once

#include "calib/diagnose/select/fit.h"
#include "calib/diagnose/select/missing_terms.h"

namespace armcal {

// How far a robot file's or a reference's numbers may be off, once effects have
// been chosen: assumptions that these contradict, and with which they are
// chosen anew.

// Friction and armature that the model has wrong on many joints at once: robot
// files have placeholders of them, and a reference may be of other torque
// sensors, behind the gears. The terms whose changes on all joints together
// explain, on three joints or both of two, more of what the chosen
// effects leave than they leave themselves, each of them asked for as an effect
// is on as many joints. A single effect that explains the same was chosen
// before.
std::vector<const Effect*> ContradictedTerms(const GapFit& fit);

// The same of a reference that is of other drives or other torque sensors: on
// as many joints the terms are less than half, or more than twice, of what it
// has. Friction that changed by less is the reference's of another day (oil
// that is cold, a gear that is run in, a load that presses on it).
std::vector<const Effect*> TermsOfOtherDrives(const GapFit& fit);

// The terms that logs ask for where `file` gives none of them, of those it has
// none of and of `not_believed` (FitMissingTerms).
MissingTerms FitWithout(const std::vector<JointTerm>& not_believed,
                        const Robot& file, const BaselineOptions& options,
                        double bandwidth_hz,
                        const std::vector<GapSegment>& segments);

// FitMissingTerms to a reference: terms that the file gives and the reference
// contradicts (FindPlaceholders) are fitted to it as missing ones, too.
MissingTerms FitTermsOfReference(const Robot& file,
                                 const BaselineOptions& options,
                                 double bandwidth_hz,
                                 const std::vector<GapSegment>& reference);

// Without a reference, terms that are contradicted are taken as ones that
// `file` does not give, and *missing is fitted anew. Whether there were any.
bool GiveUpContradicted(const GapFit& fit, const Robot& file,
                        const BaselineOptions& options, double bandwidth_hz,
                        const std::vector<GapSegment>& segments,
                        MissingTerms* missing);

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

// The same of the deviations of a calibration's posterior.
double LikeliestPosterior(const GapFit& fit);

}  // namespace armcal
