#pragma once

#include <Eigen/Core>
#include <string>

#include "calib/loop_unknowns.h"

namespace armcal {

// The unknowns of a position loop from equations that are linear in them,
// R x = z whitened, and the prior that the files are: links physically
// consistent, friction, armature and gains not negative.
class LoopFit {
 public:
  LoopFit(const LoopUnknowns& unknowns, const LoopTrust& trust);

  // *x becomes the solution, which is the only one; what is held stays. False
  // where numbers overflow.
  bool Solve(const Eigen::MatrixXd& R, const Eigen::VectorXd& z,
             Eigen::VectorXd* x) const;
  // Twice the negative logarithm of the prior, but for a constant.
  double PriorCost(const Eigen::VectorXd& x) const;
  // Its information near the files' values, of all unknowns, if they are
  // trusted to `inertia` and all else `times` as far.
  Eigen::MatrixXd PriorInformation(double inertia, double times) const;

 private:
  const LoopUnknowns& unknowns_;
  double inertia_;
  Eigen::VectorXd files_;  // values, links inside what bodies can be
};

}  // namespace armcal
