#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// How a model predicts readings that it has not seen: the mean of the squared
// distances of each, NaN where there is no prediction, and which of them it
// gives up, ascending.
struct PredictedSquares {
  Eigen::ArrayXd squares;
  std::vector<int> outliers;
};

// A row for each model and a column for each pose that all of them predict: the
// mean over its readings but those that every model gives up, gross errors
// which nothing predicts. A pose counts once however often it was read, since
// its readings share its error (shared_errors.h).
Eigen::MatrixXd SquaresByPose(const std::vector<PredictedSquares>& models,
                              const std::vector<int>& pose_of_row);

// By how much `one` is larger than `other` in the mean over the poses, and the
// standard error of that: of the differences, pose by pose, since a pose that
// is hard to predict is so for both.
struct HeldOutExcess {
  double mean = 0;
  double stderr_of_mean = 0;

  // By more than its standard error (Breiman, Friedman, Olshen, Stone 1984,
  // 3.4.3).
  bool is_clear() const { return mean > stderr_of_mean; }
};
HeldOutExcess ExcessOf(const Eigen::RowVectorXd& one,
                       const Eigen::RowVectorXd& other);

}  // namespace armcal
