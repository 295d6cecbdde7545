#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "tests/blind/blind_case.h"

namespace armcal {

// How visible an effect is, apart from any diagnosis: the share of its torque
// that re-estimating what the model has anyway (the robot's parameters within
// their prior, the width of friction's zero velocity, timing) cannot absorb,
// relative to the noise (ENR of shared/GAP.md B: sqrt(Delta / N), N samples of
// each joint at 25 Hz after a low pass at 10 Hz). The noise is that of the
// residual, from a run with noise and the same without, as an autoregression.
struct EffectSize {
  double enr = 0;
  Eigen::VectorXd joint_enr;  // its shares per joint, root sum square = enr
  double raw = 0;             // the same before anything is absorbed
};

// Of each effect of the case, from a pair of noiseless runs, one with all
// effects and one without this one: the label of a case. Nothing where the arm
// does not follow its motion in one of them.
std::optional<std::vector<EffectSize>> EffectSizes(const BlindCase& blind);

}  // namespace armcal
