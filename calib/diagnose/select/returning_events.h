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

// An event's torque on the joint that felt it most, and what of it is left
// where the arm comes back to the state of its peak: means over the core of the
// event's window (its middle half), and over these times.
struct Returning {
  double own = 0;
  double returned = 0;  // 0 where the arm never comes back
  int times = 0;        // that it does
};
// In N m or N. `left`: thinned samples x joints, what model and effects leave.
Returning ReturningTorque(const GapRows& rows, const Eigen::MatrixXd& left,
                          const GapEvent& event);
// Of each event, in units of the joint's noise; 0 of those at rest, where a
// joint's friction holds what it held before.
std::vector<Returning> ReturningTorques(
    const GapRegression& regression, const std::vector<GapCandidate>& effects,
    const std::vector<GapEvent>& events);

// Whether these torques are those of a law: what returns is nearer to them than
// nothing is, which a law predicts and a touch does not. Taken away it leaves
// less than half of them, rms; twice the torque would be no return either.
bool Returns(const std::vector<Returning>& torques);

// All events, unless their torque returns with the state (all of them together:
// single ones may be parts of a push, and next to nothing by themselves); then
// those that by themselves do not return.
std::vector<GapEvent> WithoutReturning(const GapRegression& regression,
                                       const std::vector<GapCandidate>& effects,
                                       const std::vector<GapEvent>& events);

}  // namespace armcal
