#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/changes/course.h"
#include "calib/diagnose/changes/series_fit.h"

namespace armcal {

// Something that may have changed, by an unknown amount of each of its columns.
struct ChangeHypothesis {
  LogColumns columns;     // of each log
  Eigen::VectorXd prior;  // standard deviations of the amounts
  // Components of the scatter that look alike: a change has to beat these.
  std::vector<int> scatter;
  double share = 0;  // of changes that are of this, before any log
  int family = 0;    // several descriptions of one thing have the same
  // Logs x kMotionMeasures, of the joints that it moves (MotionMeasures); no
  // columns: unknown.
  Eigen::MatrixXd motion;
};

}  // namespace armcal
