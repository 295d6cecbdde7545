#pragma once

#include <vector>

#include "calib/poses/diagnosis/finding.h"

namespace armcal {

// An effect's amounts with their 95 % intervals, of Student's t with as many
// degrees of freedom as independent equations are to spare, and their
// covariance times its quantile squared: half-widths are roots of its diagonal.
struct PoseAmounts {
  std::vector<PoseAmount> amounts;
  Eigen::MatrixXd ci95;
};
// Of each effect.
std::vector<PoseAmounts> AmountsOf(const PoseStudy& study,
                                   const PoseModel& model,
                                   double design_effect);

// Poses at which an effect that begins or ends there may do so: where -2 log p
// rises by less than 3.84, its 95 % quantile. {-1, -1}: it has no such side.
struct PoseRange {
  int first = -1, last = -1;
};
PoseRange SideOf(const PoseStudy& study, const PoseModel& model, size_t effect,
                 int PosePlace::*side, double design_effect);

}  // namespace armcal
