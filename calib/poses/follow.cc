#include "calib/poses/follow.h"

#include <cmath>
#include <limits>

namespace armcal {

using Eigen::MatrixXd;

double PoseExtent(const PoseMeasurements& measured) {
  if (!measured.touched.empty()) return std::numeric_limits<double>::infinity();
  MatrixXd p = measured.lengths;
  if (!measured.targets.empty()) p = measured.targets[0];
  if (measured.poses.size() > 0) p = measured.poses.leftCols(3);
  if (measured.tilts.size() > 0) p = measured.tilts;
  const MatrixXd about = p.rowwise() - p.colwise().mean();
  return about.norm() / std::sqrt(static_cast<double>(p.rows()));
}

bool FollowsJoints(double median, double extent) {
  constexpr double kMostDeviation = 0.1;  // share of the extent
  return !(median > kMostDeviation * extent);
}

}  // namespace armcal
