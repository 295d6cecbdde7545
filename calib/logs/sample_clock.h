#pragma once

#include <Eigen/Core>

#include "model/log_files/log.h"

namespace armcal {

// When the samples of a log were really taken. All joints share one clock: what
// their positions changed by from row to row is the integral of their
// velocities over the time between, so that each joint i that moves measures
// the step k of the clock,
//   dt[k] = sum_i v_i dq_i / s_i^2  /  sum_i v_i^2 / s_i^2,
// with variance 1 / sum_i v_i^2 / s_i^2 where s_i is the noise of dq_i
// (VelocityLaw says what v_i and dq_i are). A velocity that is late or scaled
// is one joint's affair; a clock is told only by what two groups of joints,
// each with half of the information, say independently.
struct SampleClock {
  int windows = 0;  // of .1 s or more in which both groups tell the rate to 1 %
  double period = 0, period_stddev = 0;  // s, mean true time between rows
  double rate = 1;                       // true time over the stamps'
  double wander = 0;       // rms of the rate's deviation that both groups share
  double correlation = 0;  // of the groups' rates over the windows
  long repeated = 0;       // rows of the time of the row before, in truth
  long skipped = 0;        // steps of one and a half mean steps and more
  bool wrong_rate = false;  // by more than 1 %
  bool uneven = false;      // rows are not when stamps say, by more than 1 %
  // rms of what single steps differ from the stamps' by, s, as both groups say
  // alike, and their correlation over the steps.
  double jitter = 0, step_correlation = 0;
  // Of a clock that is not wrong: time explains more than half of what the
  // groups' steps differ from the stamps' by. Stamps jitter about the rows'
  // time, which the joints tell better.
  bool jitters = false;
  // The time of each row, s since the first; empty unless the clock is wrong or
  // jitters. The mean step of one that jitters is the stamps'; in between it is
  // the joints' (a Panda's stamps wander over seconds, too).
  Eigen::VectorXd t;

  bool wrong() const { return wrong_rate || uneven; }
};

// The log has q and its time in s. Where it has no qd, or fewer than two joints
// move as their velocities say, nothing is told. A qd that was derived from q
// by the stamps agrees with these by construction: that, too, tells nothing.
SampleClock EstimateSampleClock(const Log& log);

}  // namespace armcal
