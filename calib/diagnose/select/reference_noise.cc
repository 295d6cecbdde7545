#include "calib/diagnose/select/reference_noise.h"

#include <algorithm>
#include <cmath>

#include "calib/diagnose/data/data.h"
#include "calib/diagnose/data/motion_range.h"
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

// E r^2 = a + b g^2, g the sample's motion over the log's usual largest
// (MotionRange::OwnRatio): what of a residual is noise, and what grows with the
// motion, as errors of inertias and of friction's curve do. A variance function
// (Carroll and Ruppert 1988) by quasi-likelihood: squares have a variance
// that is as the square of their mean, so that weights are 1 / (a + b g^2)^2,
// in turns. 0 <= a, b.
struct VarianceOfMotion {
  double a = 0, b = 0;
  double At(double motion) const { return a + b * motion; }  // of E g^2
};

VarianceOfMotion FitVariance(const VectorXd& squares, const VectorXd& motion) {
  constexpr int kTurns = 5;
  const double mean = squares.mean();
  const double least = 1e-3 * mean;  // of a: weights stay finite
  VarianceOfMotion fit{mean, 0};
  for (int turn = 0; turn < kTurns; ++turn) {
    const VectorXd weight =
        (fit.a + least + fit.b * motion.array()).square().inverse();
    const double w = weight.sum(), wm = weight.dot(motion),
                 wmm = weight.dot(motion.cwiseAbs2()), ws = weight.dot(squares),
                 wms = weight.cwiseProduct(motion).dot(squares);
    const double det = w * wmm - wm * wm;
    if (!(det > 1e-9 * w * wmm)) return {mean, 0};
    fit = {(wmm * ws - wm * wms) / det, (w * wms - wm * ws) / det};
    if (fit.b < 0) return {mean, 0};
    if (fit.a < 0) fit = {0, wms / wmm};
  }
  return fit;
}

// The variance that a joint's noise, as a reference has it, has in motion as
// the diagnosed logs have it, as a share of 1 or less. Motion beyond the
// reference's is no faster than that here: DistrustOtherMotion knows of it.
double ShareInMotion(const GapRows& reference, const VectorXd& seen,
                     const GapRows& diagnosed, int j) {
  const MotionRange range(reference);
  const auto motion_of = [&](const GapRows& rows) {
    const std::vector<int> of_rows = rows.SampleOfRow(j);
    return VectorXd(
        range.OwnRatio(rows).col(j).min(1.).square().matrix()(of_rows));
  };
  const VectorXd before = motion_of(reference), now = motion_of(diagnosed);
  if (before.size() == 0 || now.size() == 0) return 1;
  const VectorXd squares = seen(reference.SampleOfRow(j)).cwiseAbs2();
  const VarianceOfMotion variance = FitVariance(squares, before);
  const double usual = variance.At(before.mean());
  if (!(usual > 0)) return 1;
  return std::min(1., variance.At(now.mean()) / usual);
}

}  // namespace

// The noise of a joint is what a fit to the reference leaves, times that
// growth; and since other motion may be as unlike these parts as they are to
// each other, its square less 1 is an extra variance of which no claim may be
// made.
GapNoise ReferenceNoise(const GapBaseline& baseline,
                        const std::vector<GapSegment>& segments,
                        const GapRows& diagnosed) {
  GapData all(segments, baseline, diagnosed.bandwidth_hz());
  const MatrixXd seen = all.ResidualWith(FitWithNoise(&all));
  GapNoise noise = ResidualNoise(all.rows(), seen);
  all.SetNoise(noise.joints);
  const VectorXd grows =
      GrowthOfUnseen(segments, all, noise.joints, Moving(all.rows(), seen));
  for (int j = 0; j < grows.size(); ++j) {
    const double share = ShareInMotion(all.rows(), seen.col(j), diagnosed, j);
    noise.joints[j].sigma *= grows[j] * std::sqrt(share);
    // Motion may as well be as unlike these parts as they are to each other.
    noise.extra_variance.push_back(grows[j] * grows[j] - 1);
  }
  return noise;
}

}  // namespace armcal
