#pragma once

#include <Eigen/Core>

#include "calib/diagnose/data/baseline.h"
#include "calib/diagnose/data/data.h"
#include "calib/diagnose/data/rows.h"

namespace armcal {

// The values of the baseline that fit the data best, joints weighted by what
// they leave, as white noise, which data then have. Weights of frequencies
// would trade what is large for what is quick: what a model lacks is no noise.
Eigen::VectorXd FitWithNoise(GapData* data);
// The model's own columns are fitted alone, those of the discrepancy held at 0:
// what a robot file can hold. By the weights that the data have and within the
// file's prior; and likewise by what it leaves, of values that the file hardly
// holds.
Eigen::VectorXd FitModel(const GapBaseline& baseline, const GapData& data);
Eigen::VectorXd FitModelWithNoise(const GapBaseline& baseline, GapData* data);

// Residuals (thinned samples x n, N m or N) of joints that move; of others 0.
Eigen::MatrixXd Moving(const GapRows& rows, const Eigen::MatrixXd& residual);

}  // namespace armcal
