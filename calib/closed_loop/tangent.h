#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/closed_loop/columns.h"
#include "calib/closed_loop/simulation.h"

namespace armcal {

// A simulated loop linearised about what it did (MotionTangent's periods under
// the drives' own derivatives).
struct LoopTangent {
  // Of simulated positions, rows as in LoopTrack::Residual(), by LoopColumns.
  Eigen::MatrixXd by_columns;
  // If asked for: how (q, qd), 2 n, at a period's end follow from themselves at
  // its begin and from the torque in it, n: 2 n x 3 n.
  std::vector<Eigen::MatrixXd> periods;
};

LoopTangent LineariseLoop(const ControllerOptions& controller,
                          const LoopValues& values, const LoopColumns& columns,
                          const LoopStretch& stretch, const LoopTrack& track,
                          bool want_periods);

}  // namespace armcal
