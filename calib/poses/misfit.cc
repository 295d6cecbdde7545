#include "calib/poses/misfit.h"

#include <algorithm>
#include <cmath>

#include "calib/numerics/median.h"
#include "calib/poses/repeated_poses.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// In standard deviations: 3e-5 by chance, and one sided, since errors that
// alternate are of no instrument.
constexpr double kClear = 4;

// Squares in standard deviations of the instrument, and how many; coordinates
// without a stated uncertainty (0) are none.
void CompareWithInstrument(const PoseFit& fit, const PoseMeasurements& measured,
                           const PoseUnknowns& at,
                           const std::vector<int>& inliers, int num_unknowns,
                           PoseMisfit* misfit) {
  if (measured.u95.size() == 0) return;
  const MatrixXd errors = PositionErrors(fit.geometry(), measured, at);
  InstrumentErrors all;
  for (const int k : inliers) {
    for (Eigen::Index c = 0; c < errors.cols(); ++c) {
      all.Add(errors(k, c), measured.u95(k, std::min(c / fit.Width(),
                                                     measured.u95.cols() - 1)));
    }
  }
  // Of whole poses, half of the coordinates are rotations and determine their
  // share of the unknowns.
  all.Tell(num_unknowns * (measured.poses.size() > 0 ? .5 : 1), misfit);
}

}  // namespace

void InstrumentErrors::Add(double error, double u95) {
  if (!(u95 > 0)) return;
  const double normal = kNormal95 * error / u95;
  squares_ += normal * normal;
  stated_.push_back(u95);
}

void InstrumentErrors::Tell(double taken, PoseMisfit* misfit) const {
  const auto count = static_cast<double>(stated_.size());
  if (count <= taken) return;
  misfit->instrument_ratio = std::sqrt(squares_ / (count - taken));
  misfit->instrument_u95 = Median(stated_);
}

bool IsAlikeInOrder(const PoseMisfit& misfit) {
  return misfit.order_correlation > kClear * misfit.order_stddev;
}

// The correlation of what is left of successive poses, over pairs that do
// follow each other; of a pose that was read several times, of the mean, since
// what the arm errs by is the same in all its readings. Of independent errors
// it is 0 with the deviation 1 / sqrt(pairs).
PoseMisfit MeasureMisfit(const PoseFit& fit, const PoseMeasurements& measured,
                         const PoseUnknowns& at,
                         const std::vector<int>& inliers, int num_unknowns) {
  PoseMisfit misfit;
  if (inliers.size() < 3) return misfit;
  CompareWithInstrument(fit, measured, at, inliers, num_unknowns, &misfit);
  const VectorXd r = fit.Residuals(inliers, at);
  // Poses without an inlier have no mean.
  const std::vector<int> all = RepeatedPoses(measured.q);
  std::vector<int> pose_of_inlier;
  for (const int k : inliers) pose_of_inlier.push_back(all[k]);
  const MatrixXd poses = MeansByPose(
      r.reshaped(r.size() / inliers.size(), inliers.size()), pose_of_inlier);
  double product = 0, before = 0, after = 0, pairs = 0;
  for (Eigen::Index k = 0; k + 1 < poses.cols(); ++k) {
    if (!poses.middleCols(k, 2).allFinite()) continue;
    product += poses.col(k).dot(poses.col(k + 1));
    before += poses.col(k).squaredNorm();
    after += poses.col(k + 1).squaredNorm();
    pairs += 1;
  }
  if (!(before * after > 0)) return misfit;
  misfit.order_correlation = product / std::sqrt(before * after);
  // As if a pose were one number: errors of its coordinates may be one error.
  misfit.order_stddev = 1 / std::sqrt(pairs);
  return misfit;
}

VectorXd MotionShare(const MatrixXd& q, const std::vector<int>& inliers) {
  const auto squares = [](const MatrixXd& rows) -> VectorXd {
    return (rows.rowwise() - rows.colwise().mean())
        .colwise()
        .squaredNorm()
        .transpose();
  };
  if (inliers.empty()) return VectorXd::Zero(q.cols());
  const VectorXd all = squares(q);
  const VectorXd some = squares(q(inliers, Eigen::all));
  return (all.array() > 0).select(some.cwiseQuotient(all), 1);
}

std::string OrderSentence(const PoseMisfit& misfit) {
  if (!IsAlikeInOrder(misfit)) return "";
  return "what is left of successive poses is alike (correlation " +
         Format("%.2f", misfit.order_correlation) +
         "): something moved or drifted while they were measured, or the arm "
         "does what its geometry lacks; standard deviations know nothing of a "
         "drift";
}

}  // namespace armcal
