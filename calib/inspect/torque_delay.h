#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "calib/logs/wiring.h"

namespace armcal {

// How late torques are, s (negative: early), as the joints tell it. One clock
// stamps all torques, while what a model lacks looks late or early in each
// joint in a way of its own: so what joints say apart is the measure of how
// well a delay is known.
struct TorqueDelay {
  double best = 0;      // what leaves least in all joints together
  bool inside = false;  // best is no end of what was searched
  // Of the joints' delays, each with its own error and a scatter that they
  // have in common (DerSimonian and Laird 1986).
  double mean = 0, stddev = 0;
  bool known = false;  // more than half of the joints asked tell one
  int joints = 0;      // that tell one

  // Whether the mean's interval of 95 % lies beyond that, on either side.
  bool IsBeyond(double least) const;
};

// `fit` is that of the motion, `torques(d)` are the samples recorded d s later;
// joints that are not `asked` tell nothing.
TorqueDelay FindTorqueDelay(
    const TorqueFit& fit, const std::function<Eigen::MatrixXd(double)>& torques,
    const std::vector<bool>& asked);

}  // namespace armcal
