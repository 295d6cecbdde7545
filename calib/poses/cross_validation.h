#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/poses/fit.h"

namespace armcal {

// Distances (m; rad of tilts) of poses that a fit has not seen, a row for each
// pose and a column for each target: every folds-th pose is left out in turn,
// with all its readings (repeated_poses.h), and predicted from the others.
// `free` flags the geometry's parameters, `start` is where each fit starts; NaN
// in a fold whose fit has no usable solution. Without rows for fewer than two
// folds.
Eigen::MatrixXd LeftOutDistances(const PoseFit& fit,
                                 const std::vector<bool>& free,
                                 const PoseUnknowns& start, RobustLoss loss,
                                 int folds);

// The mean of each row's squares.
Eigen::ArrayXd MeanSquares(const Eigen::MatrixXd& distances);

// The loss that predicts poses it has not seen best, where the user names none.
//
// Tukey's gives up poses that are far off. That is right of gross errors; of
// poses that the geometry cannot explain (sag, a reflector that moved) it gives
// up a part of the workspace, and predicts that part worse. Each loss's mean of
// squared distances is cross-validated, over all readings but those that each
// of the losses gives up. The most robust loss is taken that is not clearly
// worse than the best, pose by pose (held_out_comparison.h): thirty readings of
// ten poses are ten poses. Where Tukey's gives up no reading the others are not
// tried: they would be much the same.
RobustLoss ChoosePoseLoss(const Robot& robot, const PoseMeasurements& measured,
                          PoseCalibrationOptions options);

}  // namespace armcal
