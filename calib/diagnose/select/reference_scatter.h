#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/data/baseline.h"
#include "calib/diagnose/data/data.h"

namespace armcal {

// How much of an effect the logs of a reference show by themselves, given the
// model that all of them have: robots are not the same from log to log (cables
// lie otherwise, grease is warm), and an effect of that size is no change.
struct ReferenceScatter {
  int logs = 0;       // that move what the effect acts on
  double stddev = 0;  // between them, in units of the effect
  int freedom = 0;    // degrees, of `stddev`
  // What `stddev` would be by the noise of the evidence alone.
  double expected = 0;

  // Whether the effect, 1 in these units, is beyond what a further log shows:
  // by Student's t of these degrees of freedom at the `quantile` of its size.
  // Two logs or fewer do not tell.
  bool IsBeyond(double quantile) const;
};

// The effect's torque c at its parameters, and r, what the baseline at x leaves
// of the reference, both whitened as its evidence is: log l shows
//   b_l = c_l' r_l / (c_l' c_l)
// of it, the model being that of all logs, and
//   stddev^2 = sum_l (b_l - mean b)^2 / (logs - 1),
//   expected^2 = mean of 1 / (c_l' c_l).
// What all of them show alike is no scatter: that the reference has it as well
// is another question (ShareInReference).
ReferenceScatter ScatterBetweenLogs(const GapBaseline& baseline,
                                    const MotionScale& scale,
                                    const GapCandidate& effect,
                                    const Eigen::VectorXd& x,
                                    GapData* reference);

// The scatter of one joint's effect, given that of the same effect on others:
// three logs tell a standard deviation by two degrees of freedom, for which an
// effect would have to be ten times as large. Where a joint's own variance,
// over the expected one, is no larger than that of the others by more than
// chance (5 %, Fisher's F), all of them are estimates of one ratio, and are
// pooled (Bancroft 1944); else it stands for itself.
ReferenceScatter PooledScatter(const ReferenceScatter& own,
                               const std::vector<ReferenceScatter>& others);

}  // namespace armcal
