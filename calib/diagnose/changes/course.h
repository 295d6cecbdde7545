#pragma once

#include <Eigen/Core>

namespace armcal {

// How a change goes over the logs: from one on, ever more from one on, in one
// alone (the first or the last, too: what only they differ by may be a change
// as well), or with how the robot moves in each, which is no change of it: what
// a model lacks differs with motion, and logs whose motion grows steadily seem
// to drift.
enum class ChangeForm { kStep, kDrift, kOnce, kMotion };
const char* ChangeFormName(ChangeForm form);  // "step"

// What of a motion parameters may go with.
inline constexpr int kMotionMeasures = 4;
const char* MotionMeasureName(int measure);  // "speed"
// A drift is steady, or settles within a quarter or a tenth of the series, as
// what warms up does.
inline constexpr int kDriftShapes = 3;

struct ChangeCourse {
  ChangeForm form = ChangeForm::kStep;
  int log = 0;    // the first that has it; of kMotion 0
  int shape = 0;  // of kDrift, 0: steady; of kMotion the measure

  bool operator==(const ChangeCourse& other) const {
    return form == other.form && log == other.log && shape == other.shape;
  }
};

// How much of a change each log has: a share of what it comes to, 0 to 1; of
// kMotion by how much of the measure (MotionMeasures) it has more than others.
//   steady:   (t - t_0) / (t_end - t_0)
//   settling: (1 - exp(-(t - t_0) / T)) / (1 - exp(-(t_end - t_0) / T)).
// `times`: of the logs, ascending, any unit.
Eigen::VectorXd CourseOf(const ChangeCourse& course,
                         const Eigen::VectorXd& times,
                         const Eigen::MatrixXd& motion);

// How joints move in each log, of any unit: logs x joints.
struct LogMotions {
  Eigen::MatrixXd speed;   // rms
  Eigen::MatrixXd travel;  // largest less smallest position
  Eigen::MatrixXd torque;  // rms
};

// Logarithms of rms speed v, travel s and the acceleration that these make,
//   log v, log s, 2 log v - log s,
// less their means over the logs, mean of the joints from `first` to `last`;
// and by what all joints' log v and log s together differ most, their first
// principal component (logs x kMotionMeasures). Where a parameter goes with one
// of them its amounts are those of a motion that has e times as much.
// No columns where all logs have the same torques, replayed: then it is the
// motion that goes with the parameters.
Eigen::MatrixXd MotionMeasures(const LogMotions& motions, int first, int last);

}  // namespace armcal
