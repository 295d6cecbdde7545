#include "calib/poses/cross_validation.h"

#include <algorithm>
#include <cmath>

#include "calib/poses/outliers.h"
#include "calib/poses/pose_solution.h"
#include "calib/poses/repeated_poses.h"

namespace armcal {
namespace {

// A loss, which poses are outliers to it, and the mean of the squared distances
// of each pose as it was predicted; without rows where that was not asked.
struct LossTried {
  RobustLoss loss;
  std::vector<int> outliers;
  Eigen::ArrayXd squares;
};

LossTried Try(RobustLoss loss, const Robot& robot,
              const PoseMeasurements& measured,
              PoseCalibrationOptions options) {
  options.loss = loss;
  LossTried tried = {loss, {}, {}};
  PoseFit fit(robot, measured, options);
  const PoseSolution solution = SolvePoses(measured, options.refine, &fit);
  if (!solution.refusal.empty()) return tried;
  tried.outliers = FindOutliers(fit, solution.unknowns, fit.AllRows());
  if (loss == RobustLoss::kTukey && tried.outliers.empty()) return tried;
  tried.squares = LeftOutDistances(fit, solution.free, solution.unknowns, loss,
                                   options.folds)
                      .array()
                      .square()
                      .rowwise()
                      .mean();
  return tried;
}

// Poses that all have predicted and not all give up.
std::vector<int> Comparable(const std::vector<LossTried>& tried) {
  std::vector<int> poses;
  for (int k = 0; k < tried[0].squares.size(); ++k) {
    const auto predicts = [k](const LossTried& one) {
      return std::isfinite(one.squares[k]);
    };
    const auto gives_up = [k](const LossTried& one) {
      return std::binary_search(one.outliers.begin(), one.outliers.end(), k);
    };
    if (std::all_of(tried.begin(), tried.end(), predicts) &&
        !std::all_of(tried.begin(), tried.end(), gives_up)) {
      poses.push_back(k);
    }
  }
  return poses;
}

// The first whose mean is within a standard error of the least.
RobustLoss FirstNearTheLeast(const std::vector<LossTried>& tried) {
  const std::vector<int> poses = Comparable(tried);
  if (poses.empty()) return tried[0].loss;
  std::vector<Eigen::ArrayXd> squares;
  for (const LossTried& one : tried) squares.push_back(one.squares(poses));
  const Eigen::ArrayXd least = *std::min_element(
      squares.begin(), squares.end(),
      [](const auto& a, const auto& b) { return a.mean() < b.mean(); });
  const auto is_near = [&least](const Eigen::ArrayXd& one) {
    const Eigen::ArrayXd more = one - least;
    const double variance = (more - more.mean()).square().mean();
    return more.mean() <=
           std::sqrt(variance / static_cast<double>(more.size()));
  };
  const auto first = std::find_if(squares.begin(), squares.end(), is_near);
  return tried[first - squares.begin()].loss;
}

}  // namespace

Eigen::MatrixXd LeftOutDistances(const PoseFit& fit,
                                 const std::vector<bool>& free,
                                 const PoseUnknowns& start, RobustLoss loss,
                                 int folds) {
  if (folds < 2) return {};
  const int poses = fit.measured().size();
  // A pose seen whole has one distance, as a wire has; else each target its
  // own.
  const auto targets = static_cast<Eigen::Index>(
      std::max<size_t>(1, fit.measured().targets.size()));
  Eigen::MatrixXd distances =
      Eigen::MatrixXd::Constant(poses, targets, std::nan(""));
  const std::vector<int> fold_of =
      InterleavedFolds(RepeatedPoses(fit.measured().q), folds);
  for (int fold = 0; fold < folds; ++fold) {
    std::vector<int> kept, left_out;
    for (int k = 0; k < poses; ++k) {
      (fold_of[k] == fold ? left_out : kept).push_back(k);
    }
    PoseUnknowns unknowns = start;
    if (!fit.Solve(free, kept, loss, &unknowns)) continue;
    const std::vector<double> d = fit.Distances(left_out, unknowns);
    for (size_t k = 0; k < left_out.size(); ++k) {
      distances.row(left_out[k]) = Eigen::Map<const Eigen::RowVectorXd>(
          d.data() + static_cast<Eigen::Index>(k) * targets, targets);
    }
  }
  return distances;
}

RobustLoss ChoosePoseLoss(const Robot& robot, const PoseMeasurements& measured,
                          PoseCalibrationOptions options) {
  const LossTried tukey = Try(RobustLoss::kTukey, robot, measured, options);
  if (tukey.squares.size() == 0) return tukey.loss;
  std::vector<LossTried> tried = {tukey};
  for (const RobustLoss loss :
       {RobustLoss::kCauchy, RobustLoss::kHuber, RobustLoss::kSquared}) {
    LossTried one = Try(loss, robot, measured, options);
    if (one.squares.size() > 0) tried.push_back(std::move(one));
  }
  return FirstNearTheLeast(tried);
}

}  // namespace armcal
