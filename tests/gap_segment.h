#pragma once

#include <utility>

#include "calib/gap_segments.h"
#include "model/log.h"

namespace armcal {

// A log without noise as a diagnosis has it, its motion as it is; no joint
// stands still.
inline GapSegment MakeSegment(const Log& log) {
  GapSegment segment;
  segment.motion.t0 = log.t[0];
  segment.motion.dt = (log.t[log.size() - 1] - log.t[0]) / (log.size() - 1);
  segment.motion.q = log.q;
  segment.motion.qd = log.qd;
  segment.motion.qdd = log.qdd;
  segment.motion.torque = {log.tau, .5 / segment.motion.dt};
  segment.tau = log.tau;
  segment.still.setConstant(log.q.rows(), log.q.cols(), false);
  return segment;
}

}  // namespace armcal
