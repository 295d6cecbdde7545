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
  // Of the joints' delays, each with its own error and a scatter that they
  // have in common (DerSimonian and Laird 1986).
  double mean = 0, stddev = 0;
  // More than half of the joints asked whose torque the model explains tell
  // one; of what it does not explain nothing is known.
  bool known = false;
  int joints = 0;         // that tell one
  bool is_alone = false;  // there is one that could

  // Whether the mean's interval of 95 % lies beyond that, on either side.
  bool IsBeyond(double least) const;
};

// `fit` is that of the motion, `torques(d)` are the samples recorded d s later;
// joints that are not `asked` tell nothing.
TorqueDelay FindTorqueDelay(
    const TorqueFit& fit, const std::function<Eigen::MatrixXd(double)>& torques,
    const std::vector<bool>& asked);

}  // namespace armcal
