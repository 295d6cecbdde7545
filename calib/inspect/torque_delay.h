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
  // The mean without each eighth of the motion, towards that side:
  // the least. What one event decides, such as a single step or the only time
  // that a joint turns round, the others do not tell.
  double weakest = 0;
  // More than half of the joints asked tell one, and two at least (of several)
  // without any eighth of the motion.
  bool known = false;
  int joints = 0;         // that tell one
  bool is_alone = false;  // one is asked, and has none to agree with

  // Whether the mean's interval of 95 % lies beyond that, on either side, and
  // the mean without any eighth of the motion as well.
  bool IsBeyond(double least) const;
};

// `fit` is that of the motion, `torques(d)` are the samples recorded d s later;
// joints that are not `asked` tell nothing.
TorqueDelay FindTorqueDelay(
    const TorqueFit& fit, const std::function<Eigen::MatrixXd(double)>& torques,
    const std::vector<bool>& asked);

}  // namespace armcal
