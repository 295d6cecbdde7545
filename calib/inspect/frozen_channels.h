#pragma once

#include <vector>

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
  // Of a position that shows by itself that it stood still (stuck_positions.h):
  // by how much it goes on in the row after it, rad or m.
  double jump = 0;
};

// Many torques and positions stand still rightly: those of rounded values, of
// drives that are off or at their limit, of joints that rest. So two hypotheses
// have to fail.
//
// Chance: fewer than e^-15 runs as long are expected (TooLongForChance). Of a
// position one second is asked for instead, as joints that rest repeat theirs
// for as long as they rest.
//
// That it was so: an arm, its inertias free, is fitted to the torques of all
// other rows (RowsFit). What it leaves there of the joint's torque has the
// variance v, and the torque itself V. The fit's torque at the run's motion
// minus the recorded one is N(0, v) if the record is right (v with the fit's
// own variance there), and N(0, V + v) if it has nothing to do with the arm.
// The second has to be 100 R times likelier, R being the runs that are asked in
// the log, of as many samples as are independent (IndependentSamples): of a
// hundred right logs one may have a false claim. Of zeros those samples count
// in which the joint gains speed: where it loses some, a brake may do that
// whose drive is off. A torque at an end of its range may be cut off there,
// unless less is needed. A joint that rests needs what its links weigh there,
// an offset, and friction of either direction up to twice the sliding one; or
// it is held by a brake, and its torque is constant. That its position is
// wrong, the other joints' torques tell, too.
std::vector<FrozenChannel> FindFrozenChannels(const Robot& robot,
                                              const Log& log,
                                              const UniformSeries& series);

}  // namespace armcal
