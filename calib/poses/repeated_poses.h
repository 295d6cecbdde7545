#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// Which pose of the arm each row of joint positions is a reading of, counted
// from 0 in the order in which they come first. Rows whose joints stand within
// 1e-4 rad or m of each other are of one pose: an instrument that reads
// thrice, or an arm that comes back. Such readings share whatever the arm errs
// by there, so that each of them tells less than a pose of its own.
std::vector<int> RepeatedPoses(const Eigen::MatrixXd& q);

// How many poses these are.
int CountPoses(const std::vector<int>& pose_of_row);

// Means over the readings of each pose: a column for each row becomes one for
// each pose.
Eigen::MatrixXd MeansByPose(const Eigen::MatrixXd& by_row,
                            const std::vector<int>& pose_of_row);

// Which of so many parts each row is left out with, every reading of a pose
// with the others: were one of them fitted, it would predict the rest however
// wrong the model is. Interleaved: every folds-th pose is in a part;
// contiguous: a part is a stretch of the order.
std::vector<int> InterleavedFolds(const std::vector<int>& pose_of_row,
                                  int folds);
std::vector<int> ContiguousFolds(const std::vector<int>& pose_of_row,
                                 int folds);

}  // namespace armcal
