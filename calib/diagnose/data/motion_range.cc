#include "calib/diagnose/data/motion_range.h"

#include <algorithm>
#include <vector>

#include "calib/diagnose/data/thresholds.h"
#include "calib/numerics/median.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Thinned samples x n.
MatrixXd Velocities(const GapRows& rows) {
  std::vector<MatrixXd> all;
  for (const GapSegment& segment : rows.segments()) {
    all.push_back(segment.motion.qd);
  }
  return rows.ThinAll(all);
}
// The same, without signs.
MatrixXd Speeds(const GapRows& rows) { return Velocities(rows).cwiseAbs(); }
MatrixXd Accelerations(const GapRows& rows) {
  std::vector<MatrixXd> all;
  for (const GapSegment& segment : rows.segments()) {
    all.push_back(segment.motion.qdd);
  }
  return rows.ThinAll(all).cwiseAbs();
}

// Of each joint the value that all but 5 % of its samples stay below
// (usual_motion), and not the largest: one jump of an encoder would else widen
// the range for all of the log.
VectorXd UsualLargest(const GapRows& rows, const MatrixXd& all) {
  VectorXd largest = VectorXd::Zero(all.cols());
  for (int i = 0; i < all.cols(); ++i) {
    std::vector<double> seen;
    for (int k = 0; k < rows.num_thin(); ++k) {
      if (rows.IsInPart(rows.SegmentOf(k), k)) seen.push_back(all(k, i));
    }
    if (!seen.empty()) largest[i] = Quantile(seen, Limits().usual_motion);
  }
  return largest;
}

// The largest of a row's values over their range; a joint that does not move in
// either has none.
Eigen::ArrayXd LargestRatio(const MatrixXd& all, const VectorXd& range) {
  Eigen::ArrayXd largest = Eigen::ArrayXd::Zero(all.rows());
  for (int i = 0; i < all.cols(); ++i) {
    for (int k = 0; k < all.rows(); ++k) {
      if (all(k, i) > 0)
        largest[k] = std::max(largest[k], all(k, i) / range[i]);
    }
  }
  return largest;
}

}  // namespace

MotionRange::MotionRange(const GapRows& rows)
    : accelerations_(UsualLargest(rows, Accelerations(rows))) {
  const MatrixXd velocities = Velocities(rows);
  const MatrixXd speeds = velocities.cwiseAbs();
  speeds_ = UsualLargest(rows, speeds);
  forward_ = velocities.cwiseMax(0.).colwise().sum().cwiseQuotient(
      speeds.colwise().sum());
}

Eigen::ArrayXd MotionRange::Growth(const GapRows& rows) const {
  return LargestRatio(Speeds(rows), speeds_)
      .square()
      .max(LargestRatio(Accelerations(rows), accelerations_))
      .max(1.);
}

// A way of less than 5 % (usual_motion) of all that a joint went is the noise
// of its position, or too little to fit its friction.
Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> MotionRange::Knows(
    const GapRows& rows) const {
  const double least = 1 - Limits().usual_motion;
  const MatrixXd velocities = Velocities(rows);
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> knows(velocities.rows(),
                                                           velocities.cols());
  for (int j = 0; j < velocities.cols(); ++j) {
    const bool back = !(1 - forward_[j] < least),
               ahead = !(forward_[j] < least);
    for (int k = 0; k < velocities.rows(); ++k) {
      knows(k, j) = velocities(k, j) < 0 ? back : ahead;
    }
  }
  return knows;
}

Eigen::ArrayXXd MotionRange::OwnGrowth(const GapRows& rows) const {
  const MatrixXd speeds = Speeds(rows), accelerations = Accelerations(rows);
  Eigen::ArrayXXd growth = Eigen::ArrayXXd::Ones(speeds.rows(), speeds.cols());
  for (int j = 0; j < speeds.cols(); ++j) {
    if (!(speeds_[j] > 0) || !(accelerations_[j] > 0)) continue;
    growth.col(j) = (speeds.col(j).array() / speeds_[j])
                        .square()
                        .max(accelerations.col(j).array() / accelerations_[j])
                        .max(1.);
  }
  return growth;
}

}  // namespace armcal
