#pragma once

#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/contacts/contacts.h"
#include "calib/diagnose/contacts/excess.h"
#include "calib/diagnose/select/events.h"
#include "calib/diagnose/select/regression.h"

namespace armcal {

// What the baseline and effects leave of the torque beyond friction.
FrictionExcess ExcessGiven(const GapRegression& regression,
                           const std::vector<GapCandidate>& effects);

// Whether one stretch of motion in which something stands out is a third of
// logs of so many s, or more. A touch comes and goes: what lasts has another
// cause, whose law is not fitted yet.
bool LastsTooLong(double seconds, const Contact& contact);

// How probable it is that what the model lacks as a rule is as large on some
// joint, in some stretch of the log as long as the contact, as what was felt:
// normal, of the discrepancy's standard deviation and `scale` (n) times that
// of each joint's torque. A chi squared of many samples does not ask this: what
// lasts through a stretch is not averaged there.
double ChanceByDiscrepancy(const GapRegression& regression,
                           const Contact& contact,
                           const Eigen::VectorXd& scale);

// Contacts given effects, in windows in which nothing is known yet. They
// stand out from all that friction does when nothing touches the arm, which
// only a reference tells. What one joint alone feels in motion may be its own:
// where the arm has no other, it has to stand out from the rest of the log as
// well. None of reconstructed torques: these have the drives' integrals in
// them, which wind up where friction holds.
std::vector<GapEvent> ContactsGiven(const GapRegression& regression,
                                    const std::vector<GapCandidate>& effects,
                                    const std::vector<GapEvent>& known,
                                    ContactSearch search);

}  // namespace armcal
