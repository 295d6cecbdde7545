#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/changes/series_fit.h"

namespace armcal {

// How a change goes over the logs: from one on, ever more from one on, or in
// one alone (the first or the last, too: what only they differ by may be a
// change as well).
enum class ChangeForm { kStep, kDrift, kOnce };
const char* ChangeFormName(ChangeForm form);  // "step"

// Something that may have changed, by an unknown amount of each of its columns.
struct ChangeHypothesis {
  LogColumns columns;     // of each log
  Eigen::VectorXd prior;  // standard deviations of the amounts
  // Components of the scatter that look alike: a change has to beat these.
  std::vector<int> scatter;
  double share = 0;  // of changes that are of this, before any log
  int family = 0;    // several descriptions of one thing have the same
};

// How much of a change each log has, 0 to 1.
Eigen::VectorXd CourseOf(ChangeForm form, int log,
                         const Eigen::VectorXd& times);

}  // namespace armcal
