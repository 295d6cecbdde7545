#pragma once

#include "calib/diagnose/judge/found_effect.h"

namespace armcal {

// What a body's places have in common. A body at the tool (a payload) and one
// on a link (an added mass) are one finding whose place may be open: where the
// last joint's torque does not tell them apart, as of a body on that joint's
// axis, the same mass is found on the link before it. That there is a body is
// then as probable as all its places together, which exclude each other.

// Sets FoundEffect::or_at of a body to the other places at which one of its
// `equivalent` has it, the most probable ones up to 95 % of them all, and adds
// their probability to its own. Nothing where the body's place is told, and of
// what is no body.
void PoolPlacesOfBody(FoundEffect* found);

}  // namespace armcal
