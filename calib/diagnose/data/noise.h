#pragma once

#include <string>
#include <vector>

#include "calib/diagnose/data/rows.h"
#include "calib/numerics/autoregression.h"

namespace armcal {

// What the noise of the torque residual was told from.
enum class NoiseFloor {
  kRepeats,     // motion done twice: what the model lacks falls out
  kStandstill,  // the scatter while joints stand
  kReference,  // what a model fitted to logs of the robot before leaves of them
  kPositions,  // of the encoders, which reconstructed torques have
  kAssumed     // what a refit leaves: holds what the model lacks as well
};
const char* NoiseFloorName(NoiseFloor source);
// The extra variance, as a share of the noise's: by how much that may be wrong,
// two standard deviations. Standstill hears less than motion, and what a refit
// left holds what it lacks.
double ExtraVariance(NoiseFloor source);

struct GapNoise {
  std::vector<Autoregression> joints;
  NoiseFloor source = NoiseFloor::kAssumed;
  // Share of each joint's variance that other motion may add; empty: none.
  std::vector<double> extra_variance;
};

// Noise of `residual` (per segment, fine samples x n; of any model, since only
// differences and standstill are looked at): from repeats where the motion has
// them, else from standstill. Joints with neither are left to `assumed`
// (thinned samples x n).
GapNoise EstimateGapNoise(const GapRows& rows,
                          const std::vector<Eigen::MatrixXd>& residual,
                          const Eigen::MatrixXd& assumed);

// That of a model's residual (thinned samples x n), whatever is in it.
GapNoise ResidualNoise(const GapRows& rows, const Eigen::MatrixXd& residual);

}  // namespace armcal
