#pragma once

#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/select/events.h"
#include "calib/diagnose/select/regression.h"

namespace armcal {

// A law of the joints' positions and velocities acts whenever the arm comes
// back to them, as it does in each period of a motion that is repeated; a touch
// does not wait for the arm. Where it came back within Limits().same_state, the
// torque that is left is asked of both.

// How much of an event's torque, on the joint that felt it most, is left where
// the arm comes back to the state of its peak: the mean over these times, each
// over the core of the event's window (its middle half), over the event's own.
// 1: all of it; 0: none, or the arm never comes back. `left`: thinned samples x
// joints, what model and effects leave.
double ShareThatReturns(const GapRows& rows, const Eigen::MatrixXd& left,
                        const GapEvent& event);

// Those events in motion of which less than half returns with the state; at
// rest a joint's friction holds what it held before.
std::vector<GapEvent> WithoutReturning(const GapRegression& regression,
                                       const std::vector<GapCandidate>& effects,
                                       const std::vector<GapEvent>& events);

}  // namespace armcal
