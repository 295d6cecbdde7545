#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/log_files/log.h"

namespace armcal {

// How the recorded velocity qd of a joint tells the change of its position from
// one row k to the next, by least squares over all rows:
//   q[k+1] - q[k] = gain v dt + delay a dt + curvature j dt
// where dt is the step of the stamps, v the mean of both rows' qd, and a and j
// its first and second derivative. A velocity that was recorded `delay` s late
// is the Taylor series v(t + delay) = v + delay a + ..; one that was low-passed
// has a curvature as well.
struct VelocityLaw {
  bool usable = false;   // v tells the joint's motion, to 1 % of its size
  bool derived = false;  // qd is q's difference quotient by the stamps, to 1 %
  double gain = 1;
  double delay = 0;        // s, of qd behind q
  double frequency = 0;    // rms of a over rms of v, rad/s
  double correlation = 0;  // of v dt and the position's steps
};

// What all joints say of every step of a log: rows are steps (one fewer than
// the log's rows), columns are joints. v and change are 0 at holes of the
// stamps.
struct VelocitySteps {
  Eigen::VectorXd dt;             // s, of the stamps
  Eigen::MatrixXd v;              // rad/s or m/s
  Eigen::MatrixXd change;         // of q, less the laws' delay and curvature
  std::vector<bool> still;        // no position changed
  std::vector<VelocityLaw> laws;  // per joint
};

// The log has q, qd and its time in s, and at least 4 rows.
VelocitySteps FitVelocityLaws(const Log& log);

}  // namespace armcal
