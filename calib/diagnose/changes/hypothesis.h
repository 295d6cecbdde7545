#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/changes/series_fit.h"

namespace armcal {

// How a change goes over the logs: from one on, ever more from one on, in one
// alone (the first or the last, too: what only they differ by may be a change
// as well), or with how the robot moves in each, which is no change of it: what
// a model lacks differs with motion, and logs whose motion grows steadily seem
// to drift.
enum class ChangeForm { kStep, kDrift, kOnce, kMotion };
const char* ChangeFormName(ChangeForm form);  // "step"

// What of a motion parameters may go with.
inline constexpr int kMotionMeasures = 3;
const char* MotionMeasureName(int measure);  // "speed"

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

  // How much of it each log has; of kMotion, `log` is the measure.
  Eigen::VectorXd Course(ChangeForm form, int log,
                         const Eigen::VectorXd& times) const;
};

// How much of a change of the robot each log has, 0 to 1; not of kMotion.
Eigen::VectorXd CourseOf(ChangeForm form, int log,
                         const Eigen::VectorXd& times);

// Logarithms of rms speed, travel and the acceleration that these make,
//   log v, log s, 2 log v - log s,
// less their means over the logs, mean of some joints (logs x kMotionMeasures):
// where a parameter goes with one of them its amounts are those of a motion
// that has e times as much. `speed` and `travel`: logs x joints, of any unit.
Eigen::MatrixXd MotionMeasures(const Eigen::MatrixXd& speed,
                               const Eigen::MatrixXd& travel);

}  // namespace armcal
