#include "calib/poses/diagnosis/held_out.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "calib/poses/repeated_poses.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Standard deviations: one-sided 2.3 % by chance, for what the evidence in
// sample has already chosen. Effects that few poses show have no more.
constexpr double kClearGain = 2;
// Of the mean square. What removes less is a third of the noise or
// of what else is missing, and told by what that happens to be.
constexpr double kLeastRemoved = .1;

// Of what all poses tell of an amount beside the geometry: what is left of it
// by rounding.
constexpr double kHardlyTold = 1e-6;

}  // namespace

std::vector<int> EverySixthPose(const PoseStudy& study) {
  return InterleavedFolds(RepeatedPoses(study.measured.q), kPoseFolds);
}

std::vector<int> SixStretches(const PoseStudy& study) {
  return ContiguousFolds(RepeatedPoses(study.measured.q), kPoseFolds);
}

// Without a fold, the normal equations lose J_f' J_f and J_f' r_f, and one
// Gauss-Newton step leads from the whole fit to that without it: six solutions
// of small systems instead of six fits.
VectorXd HeldOutResiduals(const PoseStudy& study, const PoseModel& model,
                          const std::vector<int>& folds) {
  const PoseEquations& equations = study.equations;
  const PoseEstimate& at = model.estimate;
  const MatrixXd own = equations.Columns(at.linear, model.terms);
  MatrixXd J(own.rows(), at.linear.geometry.cols() + own.cols());
  J << at.linear.geometry, own;
  J = WeightedRows(at, J);
  const VectorXd r = WeightedRows(at, at.linear.r);
  MatrixXd all = PoseInformation(equations, at, own);
  all.diagonal().array() += 1e-9;
  VectorXd pull = -J.transpose() * r;
  pull -= PriorPull(equations, model.terms, at.state);
  // Other poses may not tell an effect at all, one that begins and ends among
  // those left out: then they know nothing of it.
  const Eigen::Index q = own.cols();
  const VectorXd little =
      kHardlyTold * AmountsInformation(study, model).diagonal();
  all.diagonal().tail(q) += little;
  pull.tail(q) -= little.cwiseProduct(at.state.amounts);
  const int width = equations.width();
  VectorXd held(r.size());
  const int last = *std::max_element(folds.begin(), folds.end());
  for (int fold = 0; fold <= last; ++fold) {
    MatrixXd A = all;
    VectorXd b = pull;
    for (size_t k = 0; k < folds.size(); ++k) {
      if (folds[k] != fold) continue;
      const auto rows = J.middleRows(k * width, width);
      A -= rows.transpose() * rows;
      b += rows.transpose() * r.segment(k * width, width);
    }
    const PoseState moved = equations.Moved(at.state, A.ldlt().solve(b));
    const VectorXd left = equations.Residuals(model.terms, moved);
    for (size_t k = 0; k < folds.size(); ++k) {
      if (folds[k] != fold) continue;
      held.segment(k * width, width) = left.segment(k * width, width);
    }
  }
  return held;
}

double RmsDistance(const PoseStudy& study, const VectorXd& residuals) {
  const int width = study.equations.width();
  const bool whole = study.measured.poses.size() > 0;
  double squares = 0, count = 0;
  for (Eigen::Index k = 0; k < residuals.size(); k += width) {
    squares += residuals.segment(k, whole ? 3 : width).squaredNorm();
    count += whole ? 1 : std::max(1, width / 3);
  }
  return std::sqrt(squares / count);
}

VectorXd HeldOutDeviance(const PoseStudy& study, const PoseModel& model,
                         const VectorXd& residuals) {
  const int width = study.equations.width();
  const double scale = model.estimate.errors.scale, nu = model.estimate.nu;
  VectorXd deviance(study.equations.poses());
  for (int k = 0; k < study.equations.poses(); ++k) {
    const double square =
        residuals.segment(k * width, width).squaredNorm() / (scale * scale);
    const double spread =
        std::isinf(nu) ? square : (nu + width) * std::log1p(square / nu);
    deviance[k] = spread + 2 * width * std::log(scale);
  }
  return deviance;
}

bool HeldOutGain::IsClear() const {
  return deviance > kClearGain * stddev && removed_share > kLeastRemoved;
}

HeldOutGain CompareHeldOut(const PoseStudy& study, const PoseModel& without,
                           const PoseModel& with,
                           const std::vector<int>& folds) {
  const VectorXd before = HeldOutResiduals(study, without, folds);
  const VectorXd after = HeldOutResiduals(study, with, folds);
  const VectorXd by_row = HeldOutDeviance(study, without, before) -
                          HeldOutDeviance(study, with, after);
  // A pose's readings gain together, by what the pose has in common.
  const std::vector<int> pose_of_row = RepeatedPoses(study.measured.q);
  VectorXd gain = VectorXd::Zero(CountPoses(pose_of_row));
  for (Eigen::Index k = 0; k < by_row.size(); ++k) {
    gain[pose_of_row[k]] += by_row[k];
  }
  const double poses = static_cast<double>(gain.size());
  HeldOutGain result;
  result.deviance = gain.sum();
  result.stddev = std::sqrt((gain.array() - gain.mean()).square().sum() *
                            poses / std::max(1.0, poses - 1));
  result.removed_share = 1 - after.squaredNorm() / before.squaredNorm();
  return result;
}

}  // namespace armcal
