#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/poses/calibration.h"
#include "calib/poses/fit.h"
#include "model/log_files/pose_reader.h"

namespace armcal {

// What the fit leaves of the poses `inliers`, in the order of the file, with so
// many unknowns.
PoseMisfit MeasureMisfit(const PoseFit& fit, const PoseMeasurements& measured,
                         const PoseUnknowns& at,
                         const std::vector<int>& inliers, int num_unknowns);

// Per joint, how much of its motion is in `inliers`: their sum of squares about
// their mean over that of all poses, which is the share of the information on
// whatever grows with the joint's position. 1 where a joint never moves.
Eigen::VectorXd MotionShare(const Eigen::MatrixXd& q,
                            const std::vector<int>& inliers);

// Whether what is left depends on when it was measured, for people to read;
// empty where it does not.
std::string OrderSentence(const PoseMisfit& misfit);

}  // namespace armcal
