#include "calib/poses/held_out_figures.h"

#include <cmath>

#include "calib/numerics/median.h"
#include "calib/poses/cross_validation.h"
#include "calib/poses/held_out_comparison.h"
#include "calib/poses/outliers.h"
#include "calib/poses/repeated_poses.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;

std::vector<double> Finite(const MatrixXd& distances) {
  std::vector<double> finite;
  for (const double d : distances.reshaped()) {
    if (std::isfinite(d)) finite.push_back(d);
  }
  return finite;
}

// The refined geometry is compared with the file's as each predicts poses that
// it has not seen. In sample the file's has fewer unknowns to fit them by, and
// the comparison would be with another quantity.
void CompareWithFile(const PoseFit& fit, const PoseSolution& solution,
                     const PoseCalibrationOptions& options,
                     const MatrixXd& predicted, PoseCalibration* result) {
  const MatrixXd by_file = LeftOutDistances(
      fit, solution.frame_free, solution.frame, options.loss, options.folds);
  const std::vector<double> finite = Finite(by_file);
  if (finite.empty()) return;
  result->file_held_out_rms = Rms(finite);
  const MatrixXd squares =
      SquaresByPose({{MeanSquares(predicted), result->outliers},
                     {MeanSquares(by_file),
                      FindOutliers(fit, solution.frame, fit.AllRows())}},
                    RepeatedPoses(fit.measured().q));
  if (squares.cols() < 2) return;
  result->compared_rms = std::sqrt(squares.row(0).mean());
  result->file_compared_rms = std::sqrt(squares.row(1).mean());
  result->held_out_excess = ExcessOf(squares.row(0), squares.row(1));
}

void CrossValidate(const PoseFit& fit, const PoseSolution& solution,
                   const PoseCalibrationOptions& options,
                   PoseCalibration* result) {
  const MatrixXd predicted = LeftOutDistances(
      fit, solution.free, solution.unknowns, options.loss, options.folds);
  const std::vector<double> left_out = Finite(predicted);
  if (left_out.empty()) return;
  result->held_out_rms = Rms(left_out);
  result->held_out_median = Median(left_out);
  if (!result->refined) return;
  CompareWithFile(fit, solution, options, predicted, result);
}

// Nothing is fitted to poses that were kept out: the instrument, and what it
// looks at, have to be where they were.
void Validate(const PoseFit& fit, const PoseSolution& solution,
              const PoseCalibrationOptions& options, PoseCalibration* result) {
  const auto distances = [&](const PoseUnknowns& at) {
    std::vector<double> all;
    const MatrixXd errors =
        PositionErrors(fit.geometry(), *options.validation, at);
    for (Eigen::Index k = 0; k < errors.rows(); ++k) {
      for (Eigen::Index c = 0; c < errors.cols(); c += fit.Width()) {
        all.push_back(errors.row(k).segment(c, fit.Width()).norm());
      }
    }
    return all;
  };
  const std::vector<double> after = distances(solution.unknowns);
  result->validation = {options.validation->size(),
                        Rms(distances(solution.frame)), Rms(after),
                        Median(after)};
}

}  // namespace

void ReportHeldOut(const PoseFit& fit, const PoseSolution& solution,
                   const PoseCalibrationOptions& options,
                   PoseCalibration* result) {
  CrossValidate(fit, solution, options, result);
  if (options.validation != nullptr) Validate(fit, solution, options, result);
}

}  // namespace armcal
