#include "calib/diagnose/select/reference_noise.h"

#include <algorithm>
#include <cmath>

#include "calib/diagnose/data/data.h"
#include "calib/diagnose/data/screen.h"
#include "calib/diagnose/select/reference_fit.h"
#include "calib/diagnose/select/reference_folds.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// What a fit leaves of samples that it has not seen, divided by sqrt(1 + a' C a
// / v), a a sample's columns and C the covariance of their values: the
// predictive standard deviation over that of the noise. What remains above 1 is
// misfit, which parameters do not account for.
MatrixXd Unforeseen(const GapData& data, const GapRows& rows) {
  GapScreen screen = data.Screen();
  screen.Factor();
  const JointRows none(data.rows().num_joints());
  MatrixXd left = data.ResidualWith(screen.BaselineGiven(none));
  const MatrixXd covariance = screen.BaselineCovariance();
  for (int j = 0; j < left.cols(); ++j) {
    const BaselineColumns& own = data.columns()[j];
    const VectorXd variance = (own.values * covariance(own.which, own.which))
                                  .cwiseProduct(own.values)
                                  .rowwise()
                                  .sum();
    for (int k = 0; k < left.rows(); ++k) {
      left(k, j) /= std::sqrt(1 + variance[k] / rows.variance(j, k));
    }
  }
  return left;
}

// By which factor the residual of samples that a fit has not seen is larger
// than of those that it has, each joint for itself: leave-one-out
// cross-validation over the reference's parts, whole logs or the thirds of a
// single one, as a ratio of root mean squares over all of them that is 1 or
// more.
VectorXd GrowthOfUnseen(const std::vector<GapSegment>& segments,
                        const GapData& all,
                        const std::vector<Autoregression>& noise,
                        const MatrixXd& seen) {
  VectorXd before = VectorXd::Zero(seen.cols()), after = before;
  for (const ReferenceFold& fold : FoldsOf(segments)) {
    GapData others(all, LogPart());
    others.SetNoise(noise);
    const std::vector<int> left_out = LeaveOut(segments, fold, &others);
    others.SetNoise(noise);
    const MatrixXd unseen = Moving(all.rows(), Unforeseen(others, all.rows()));
    before += seen(left_out, Eigen::all).colwise().squaredNorm();
    after += unseen(left_out, Eigen::all).colwise().squaredNorm();
  }
  VectorXd grows = VectorXd::Ones(seen.cols());
  for (int j = 0; j < grows.size(); ++j) {
    if (!(before[j] > 0)) continue;
    grows[j] = std::max(1., std::sqrt(after[j] / before[j]));
  }
  return grows;
}

}  // namespace

// The noise of a joint is what a fit to the reference leaves, times that
// growth; and since other motion may be as unlike these parts as they are to
// each other, its square less 1 is an extra variance of which no claim may be
// made.
GapNoise ReferenceNoise(const GapBaseline& baseline, double bandwidth_hz,
                        const std::vector<GapSegment>& segments) {
  GapData all(segments, baseline, bandwidth_hz);
  const MatrixXd seen = all.ResidualWith(FitWithNoise(&all));
  GapNoise noise = ResidualNoise(all.rows(), seen);
  all.SetNoise(noise.joints);
  const VectorXd grows =
      GrowthOfUnseen(segments, all, noise.joints, Moving(all.rows(), seen));
  for (int j = 0; j < grows.size(); ++j) {
    noise.joints[j].sigma *= grows[j];
    // Motion may as well be as unlike these parts as they are to each other.
    noise.extra_variance.push_back(grows[j] * grows[j] - 1);
  }
  return noise;
}

}  // namespace armcal
