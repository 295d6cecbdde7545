#include "calib/poses/cross_validation.h"

#include <algorithm>
#include <cmath>

#include "calib/poses/held_out_comparison.h"
#include "calib/poses/outliers.h"
#include "calib/poses/pose_solution.h"
#include "calib/poses/repeated_poses.h"

namespace armcal {
namespace {

// A loss, and how it predicts; without rows where that was not asked.
struct LossTried {
  RobustLoss loss;
  PredictedSquares held_out;
};

LossTried Try(RobustLoss loss, const Robot& robot,
              const PoseMeasurements& measured,
              PoseCalibrationOptions options) {
  options.loss = loss;
  LossTried tried = {loss, {}};
  PoseFit fit(robot, measured, options);
  const PoseSolution solution = SolvePoses(measured, options.refine, &fit);
  if (!solution.refusal.empty()) return tried;
  std::vector<int>& outliers = tried.held_out.outliers;
  outliers = FindOutliers(fit, solution.unknowns, fit.AllRows());
  if (loss == RobustLoss::kTukey && outliers.empty()) return tried;
  tried.held_out.squares = MeanSquares(LeftOutDistances(
      fit, solution.free, solution.unknowns, loss, options.folds));
  return tried;
}

// The first that is not clearly worse than the best.
RobustLoss FirstNearTheLeast(const std::vector<LossTried>& tried,
                             const std::vector<int>& pose_of_row) {
  std::vector<PredictedSquares> models;
  for (const LossTried& one : tried) models.push_back(one.held_out);
  const Eigen::MatrixXd squares = SquaresByPose(models, pose_of_row);
  if (squares.cols() < 2) return tried[0].loss;
  Eigen::Index best = 0;
  squares.rowwise().mean().minCoeff(&best);
  const auto is_near = [&](const LossTried& one) {
    return !ExcessOf(squares.row(&one - tried.data()), squares.row(best))
                .is_clear();
  };
  return std::find_if(tried.begin(), tried.end(), is_near)->loss;
}

}  // namespace

Eigen::ArrayXd MeanSquares(const Eigen::MatrixXd& distances) {
  return distances.array().square().rowwise().mean();
}

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
  if (tukey.held_out.squares.size() == 0) return tukey.loss;
  std::vector<LossTried> tried = {tukey};
  for (const RobustLoss loss :
       {RobustLoss::kCauchy, RobustLoss::kHuber, RobustLoss::kSquared}) {
    LossTried one = Try(loss, robot, measured, options);
    if (one.held_out.squares.size() > 0) tried.push_back(std::move(one));
  }
  return FirstNearTheLeast(tried, RepeatedPoses(measured.q));
}

}  // namespace armcal
