#include "calib/poses/held_out_comparison.h"

#include <algorithm>
#include <cmath>

#include "calib/poses/repeated_poses.h"

namespace armcal {
namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;

bool IsComparable(const std::vector<PredictedSquares>& models, int row) {
  const auto predicts = [row](const PredictedSquares& model) {
    return std::isfinite(model.squares[row]);
  };
  const auto gives_up = [row](const PredictedSquares& model) {
    return std::binary_search(model.outliers.begin(), model.outliers.end(),
                              row);
  };
  return std::all_of(models.begin(), models.end(), predicts) &&
         !std::all_of(models.begin(), models.end(), gives_up);
}

}  // namespace

MatrixXd SquaresByPose(const std::vector<PredictedSquares>& models,
                       const std::vector<int>& pose_of_row) {
  const auto count = static_cast<Eigen::Index>(models.size());
  MatrixXd sums = MatrixXd::Zero(count, CountPoses(pose_of_row));
  RowVectorXd readings = RowVectorXd::Zero(sums.cols());
  for (size_t row = 0; row < pose_of_row.size(); ++row) {
    if (!IsComparable(models, static_cast<int>(row))) continue;
    readings[pose_of_row[row]] += 1;
    for (Eigen::Index k = 0; k < count; ++k) {
      sums(k, pose_of_row[row]) +=
          models[k].squares[static_cast<Eigen::Index>(row)];
    }
  }
  std::vector<Eigen::Index> compared;
  for (Eigen::Index pose = 0; pose < sums.cols(); ++pose) {
    if (readings[pose] > 0) compared.push_back(pose);
  }
  const MatrixXd means = sums.array().rowwise() / readings.array();
  return means(Eigen::all, compared);
}

HeldOutExcess ExcessOf(const RowVectorXd& one, const RowVectorXd& other) {
  const ArrayXd more = (one - other).transpose().array();
  const auto count = static_cast<double>(more.size());
  return {more.mean(),
          std::sqrt((more - more.mean()).square().sum() / (count - 1) / count)};
}

}  // namespace armcal
