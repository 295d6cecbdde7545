#pragma once

#include <Eigen/Core>
#include <string>

#include "calib/diagnose/select/fit.h"

namespace armcal {

// What one joint did at each sample of its residual.
struct JointCourse {
  Eigen::VectorXd residual;      // whitened
  Eigen::VectorXd position;      // rad or m
  Eigen::VectorXd velocity;      // rad/s or m/s
  Eigen::VectorXd acceleration;  // rad/s^2 or m/s^2
  Eigen::VectorXd load;          // N m or N
  Eigen::VectorXd time;          // s
};

// Of a fit's training logs, the residual being the refitted model's without
// effects.
JointCourse JointCourseOf(const GapFit& fit, int joint);

// The coordinate that orders a residual most, in ten bins of equally many
// samples: "velocity", "speed", "position", "acceleration", "load",
// "load and direction", "time". Empty where none does more than noise would
// (chi^2 of bin means, samples correlated over a few neighbours).
struct Organisation {
  std::string by;
  double excess = 0;  // chi^2 of bin means over what noise gives
};
Organisation OrganisedBy(const JointCourse& course);

}  // namespace armcal
