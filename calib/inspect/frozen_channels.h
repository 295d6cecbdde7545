#pragma once

#include <vector>

#include "calib/logs/inspection_finding.h"
#include "calib/logs/uniform_series.h"
#include "model/log_files/log.h"
#include "model/robot/robot.h"

namespace armcal {

// Rows [begin, end) at which a recorded torque or position of one joint has one
// value although what it measures goes on: a stuck-at fault, as of a recorder
// that repeats what it got last, or writes zeros, while nothing arrives.
struct FrozenChannel {
  int joint = 0;
  bool is_position = false;
  int begin = 0, end = 0;
  double value = 0;
  double gap = 0;    // rms of the torque that the arm needs, minus recorded
  double usual = 0;  // rms of the same elsewhere, N m or N
  double nats = 0;   // by which the arm's model speaks for it
};

// Many torques and positions stand still rightly: those of rounded values, of
// drives that are off or at their limit, of joints that rest. So two hypotheses
// have to fail.
//
// Chance: of m runs of equal values whose lengths are geometrically
// distributed, P(repeats >= r) = p^r, the longest has about log m / -log p
// repeats. The longest one of all others, r2, so tells p = m^(-1/r2), and of
// runs with r repeats or more m p^r = m^(1 - r / r2) are expected. That has to
// be below e^-15. Of a position one second is asked for instead, as joints that
// rest repeat theirs for as long as they rest.
//
// That it was so: an arm, its inertias free, is fitted to the torques of all
// other rows. What it leaves there of the joint's torque has the variance v,
// and the torque itself V. The fit's torque at the run's motion minus the
// recorded one is N(0, v) if the record is right (v with the fit's own variance
// there), and N(0, V + v) if it has nothing to do with the arm. The second has
// to be e^15 times likelier, of as many samples as are independent
// (IndependentSamples). Of zeros those samples count in which the joint gains
// speed: where it loses some, a brake may do that whose drive is off. A torque
// at an end of its range may be cut off there, unless less is needed. A joint
// that rests needs what its links weigh there, an offset, and friction of
// either direction up to twice the sliding one; or it is held by a brake, and
// its torque is constant. That its position is wrong, the other joints' torques
// tell, too.
std::vector<FrozenChannel> FindFrozenChannels(const Robot& robot,
                                              const Log& log,
                                              const UniformSeries& series);

// Whether a finding is of that column: its sentence begins with the signal.
bool IsOf(const FrozenChannel& run, const InspectionFinding& finding);

// What to say of them; they lead.
std::vector<InspectionFinding> FrozenFindings(
    const Robot& robot, const Eigen::VectorXd& t,
    const std::vector<FrozenChannel>& frozen);

// The log without these rows: a hole of its stamps, as motion or torque is not
// known there.
Log WithoutFrozenRows(const Log& log, const std::vector<FrozenChannel>& frozen);

}  // namespace armcal
