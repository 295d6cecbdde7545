#pragma once

#include <Eigen/Core>

#include "calib/diagnose/data/rows.h"

namespace armcal {

// Speeds and accelerations up to which a log has each joint moved, and which
// way. Noise that was told by this log is that of motion within them.
class MotionRange {
 public:
  explicit MotionRange(const GapRows& rows);

  // By which factor what a model leaves of a torque may be larger in each
  // thinned sample of a log, 1 within the range: errors of inertias grow with
  // the accelerations, those of Coriolis terms and of drag with the square of
  // the speeds, so that it is the largest of (speed / range)^2 and
  // acceleration / range of all joints.
  Eigen::ArrayXd Growth(const GapRows& rows) const;
  // The same of each joint by its own motion alone, thinned samples x n; 1
  // where the log has no motion of it.
  Eigen::ArrayXXd OwnGrowth(const GapRows& rows) const;
  // Whether each joint has moved the way that it moves in each thinned sample
  // of a log, thinned samples x n: of one that turned one way only, friction
  // cannot be told from a wrong zero, so that nothing is known of its torque on
  // the way back.
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> Knows(
      const GapRows& rows) const;

 private:
  Eigen::VectorXd speeds_, accelerations_;  // per joint
  Eigen::VectorXd forward_;  // share of each joint's way; NaN of no way
};

}  // namespace armcal
