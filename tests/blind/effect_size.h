#pragma once

#include <Eigen/Core>
#include <vector>

#include "tests/blind/blind_case.h"

namespace armcal {

// How visible an effect is, apart from any diagnosis: the share of its torque
// that re-estimating what the model has anyway (the robot's parameters within
// their prior, the width of friction's zero velocity, timing) cannot absorb,
// relative to the noise (ENR of shared/GAP.md B: sqrt(Delta / N), N samples of
// each joint at 25 Hz after a low pass at 10 Hz).
struct EffectSize {
  double enr = 0;
  Eigen::VectorXd joint_enr;  // its shares per joint, root sum square = enr
  double raw = 0;             // the same before anything is absorbed
};

// Of each effect of the case, from a pair of noiseless runs, one with all
// effects and one without this one. The label of a case.
std::vector<EffectSize> EffectSizes(const BlindCase& blind);

}  // namespace armcal
