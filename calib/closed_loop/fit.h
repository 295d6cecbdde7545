#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/closed_loop/torque_information.h"
#include "calib/closed_loop/unknowns.h"

namespace armcal {

// The unknowns of a position loop from equations that are linear in them,
// R x = z whitened, and what is known without: that the files are about right,
// links physically consistent, friction, armature and gains not negative, and
// what logs with torques say, if there are any.
class LoopFit {
 public:
  // `torques`, null without any, is kept by reference.
  LoopFit(const LoopUnknowns& unknowns, const LoopTrust& trust,
          const TorqueInformation* torques);

  // *x becomes the solution, which is the only one; what is held stays. False
  // where numbers overflow.
  bool Solve(const Eigen::MatrixXd& R, const Eigen::VectorXd& z,
             Eigen::VectorXd* x) const;
  // Twice the negative logarithm of what is known without them, but for a
  // constant.
  double PriorCost(const Eigen::VectorXd& x) const;
  // Torques' equations as rows of all unknowns; none without torques.
  Eigen::MatrixXd TorqueRows() const;
  // The covariance of their scores, likewise.
  Eigen::MatrixXd TorqueScores() const;
  // The information of the files near the files' values, of all unknowns, if
  // they are trusted to `inertia` and all else `times` as far.
  Eigen::MatrixXd PriorInformation(double inertia, double times) const;

 private:
  // Indices of unknowns: of links that are held, and what Solve() asks for.
  std::vector<int> HeldLinks() const;
  std::vector<int> Asked() const;

  const LoopUnknowns& unknowns_;
  const TorqueInformation* torques_;
  double inertia_;
  Eigen::VectorXd files_;  // values, links inside what bodies can be
};

}  // namespace armcal
