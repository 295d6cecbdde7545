#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/force_torque/samples.h"

namespace armcal {

// What the forces alone tell of a sensor's load, by linear least squares.
//
// A body of mass m that moves without much turning needs the force m (a - g),
// which the sensor gives in its own axes with its bias b:
//   f = M u + b,  M = s m R_SL,  u = a - g in the last link's axes,
// s = 1, or -1 for a sensor that reports the force of the load instead. M and b
// can be told apart only in directions in which u changes.
struct ForceTorqueStart {
  // M in the directions that are told; 0 in the others.
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
  int directions = 0;  // that are told, of three
  double mass = 0;     // kg, the mean of M's singular values in these
};

// A direction v, an eigenvector of the covariance of u, is told where |M v| is
// ten standard deviations or more: the mass then is known to a tenth, the
// rotation to six degrees. Samples that follow each other are counted by the
// autocorrelation time of what is left; those in which something touches the
// load pull with a bounded force (Huber).
ForceTorqueStart StartForceTorque(
    const std::vector<ForceTorqueSample>& samples);

}  // namespace armcal
