#pragma once

#include <Eigen/Core>

namespace armcal {

// What residuals of one kind, in units of their noise, say about it; per joint.
struct NoiseSums {
  explicit NoiseSums(int num_joints);

  Eigen::ArrayXd count;
  Eigen::ArrayXd fitted;   // degrees of freedom that the spline took
  Eigen::ArrayXd squares;  // of psi
  Eigen::ArrayXd slope;    // of psi'
  Eigen::ArrayXd outliers;
};

}  // namespace armcal
