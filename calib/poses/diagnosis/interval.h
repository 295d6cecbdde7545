#pragma once

#include <vector>

#include "calib/poses/diagnosis/finding.h"

namespace armcal {

// Each effect's amounts with 95 % intervals, effect by effect: of Student's t
// with as many degrees of freedom as independent equations are to spare.
std::vector<std::vector<PoseAmount>> AmountsOf(const PoseStudy& study,
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
