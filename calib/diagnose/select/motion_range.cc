#include "calib/diagnose/select/motion_range.h"

#include <vector>

#include "calib/diagnose/data/thresholds.h"
#include "calib/numerics/median.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;

// Thinned samples x 2 n: speeds of all joints, then accelerations.
MatrixXd SpeedsAndAccelerations(const GapRows& rows) {
  std::vector<MatrixXd> both;
  for (const GapSegment& segment : rows.segments()) {
    const Motion& motion = segment.motion;
    both.emplace_back(motion.size(), 2 * motion.num_joints());
    both.back() << motion.qd, motion.qdd;
  }
  return rows.ThinAll(both).cwiseAbs();
}

}  // namespace

MotionRange::MotionRange(const GapRows& rows) {
  const MatrixXd all = SpeedsAndAccelerations(rows);
  largest_.resize(all.cols());
  for (int i = 0; i < all.cols(); ++i) {
    std::vector<double> seen;
    for (int k = 0; k < rows.num_thin(); ++k) {
      if (rows.IsInPart(rows.SegmentOf(k), k)) seen.push_back(all(k, i));
    }
    largest_[i] = seen.empty() ? 0 : Quantile(seen, Limits().usual_motion);
  }
}

Eigen::Array<bool, Eigen::Dynamic, 1> MotionRange::Contains(
    const GapRows& rows) const {
  return (SpeedsAndAccelerations(rows).rowwise() - largest_.transpose())
             .rowwise()
             .maxCoeff()
             .array() <= 0;
}

}  // namespace armcal
