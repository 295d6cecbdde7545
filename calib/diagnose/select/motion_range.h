#pragma once

#include <Eigen/Core>

#include "calib/diagnose/data/rows.h"

namespace armcal {

// Speeds and accelerations up to which a log has each joint moved. What a model
// leaves of a torque grows with both: noise that was told by this log is that
// of motion within them.
class MotionRange {
 public:
  explicit MotionRange(const GapRows& rows);

  // Of each thinned sample whether all joints are within it.
  Eigen::Array<bool, Eigen::Dynamic, 1> Contains(const GapRows& rows) const;

 private:
  Eigen::VectorXd largest_;  // speeds of all joints, then accelerations
};

}  // namespace armcal
