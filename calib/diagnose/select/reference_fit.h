#pragma once

#include <Eigen/Core>

#include "calib/diagnose/data/data.h"
#include "calib/diagnose/data/rows.h"

namespace armcal {

// The values of the baseline that fit the data best, joints weighted by what
// they leave, as white noise, which data then have. Weights of frequencies
// would trade what is large for what is quick: what a model lacks is no noise.
Eigen::VectorXd FitWithNoise(GapData* data);

// Residuals (thinned samples x n, N m or N) of joints that move; of others 0.
Eigen::MatrixXd Moving(const GapRows& rows, const Eigen::MatrixXd& residual);

}  // namespace armcal
