#pragma once

#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/data/screen.h"
#include "calib/diagnose/select/events.h"
#include "calib/diagnose/select/evidence_noise.h"
#include "calib/diagnose/select/regression.h"
#include "calib/diagnose/select/returning_events.h"

namespace armcal {

// How large what models lack as a rule is, of the routine size, by the evidence
// of a screen's rows (LogEvidence): one of 1, 3, 10 and 30, the last being as
// much as all of the torque. `discrepancy`: its columns in the baseline;
// `stddev`: those of the rows as they are (SettleNoise). The size that leaves
// the least correlation says how many samples are independent.
double DiscrepancySize(const GapScreen& screen,
                       const std::vector<int>& discrepancy,
                       const Eigen::VectorXd& stddev);

// 2 log of the odds that a joint's torque obeys a law of state and time that no
// catalogue has, against pulses that came and went,
//   max over s > usual_size of evidence(what models lack, s times the routine)
//   - evidence(what models lack, usual_size times the routine, and a pulse
//   each)
// under the variance that either leaves and the lesser correlation of both.
// A law shows in all of a log, a pulse nowhere else; and a pulse could have
// been in many places, whose number it has to outweigh.
//
// `screen`: factored, with the columns of effects that last. `pulses`: whitened
// as its rows, of a torque that is usual on their joint, which is the standard
// deviation of what a push may be. `log_places`: ln of the number of places,
// summed over pushes, of which each has one column or several.
double UnknownLawOdds(const GapScreen& screen,
                      const std::vector<int>& discrepancy, double usual_size,
                      const std::vector<JointRows>& pulses, double log_places,
                      const Eigen::VectorXd& stddev);

// The joints of the pulses among these events of which a law is the likelier
// cause: given effects that last, and given more of what models lack than the
// reference shows, where no other event was. `regression` has a reference.
std::vector<int> JointsWithUnknownLaw(const GapRegression& regression,
                                      const std::vector<GapCandidate>& effects,
                                      const std::vector<GapEvent>& events);
// Whether the arm came back to where most of a joint's pulses were felt (by
// squares), and they were not there again: then no law of its state made them.
// One of time alone is not asked of: what comes and goes in less than a second
// is none. `torques`: of each event (ReturningTorques).
bool IsLawRefuted(const std::vector<GapEvent>& events,
                  const std::vector<Returning>& torques, int joint);
// The events without the pulses on those of these joints on which it is not.
std::vector<GapEvent> WithoutPulsesOfUnknownLaws(
    const GapRegression& regression, const std::vector<GapCandidate>& effects,
    const std::vector<GapEvent>& events);

}  // namespace armcal
