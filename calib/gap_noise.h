#pragma once

#include <string>
#include <vector>

#include "calib/autoregression.h"
#include "calib/gap_rows.h"

namespace armcal {

// What the noise of the torque residual was told from.
enum class NoiseFloor {
  kRepeats,     // motion done twice: what the model lacks falls out
  kStandstill,  // the scatter while joints stand
  kAssumed      // what a rich model leaves: holds what no law explains
};
const char* NoiseFloorName(NoiseFloor source);

struct GapNoise {
  std::vector<Autoregression> joints;
  NoiseFloor source = NoiseFloor::kAssumed;
};

// Noise of `residual` (per segment, fine samples x n; of any model, since only
// differences and standstill are looked at): from repeats where the motion has
// them, else from standstill. Joints with neither are left to `assumed`
// (thinned samples x n).
GapNoise EstimateGapNoise(const GapRows& rows,
                          const std::vector<Eigen::MatrixXd>& residual,
                          const Eigen::MatrixXd& assumed);

}  // namespace armcal
