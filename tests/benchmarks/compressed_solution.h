#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "model/robot/arm_geometry.h"
#include "model/signals/trajectory.h"
#include "problems/link_functions.h"
#include "tests/benchmarks/six_axis_problem.h"

namespace armcal {

// SixAxisProblem by what `calibrate` is made of: rows of LinkFunctions, reduced
// on all threads. A Gauss-Newton iteration is exact, as its triangular factor
// is that of all samples' equations.
class CompressedSolution {
 public:
  explicit CompressedSolution(const SixAxisProblem& problem);

  // Inertial parameters, then geometric ones, as the problem has them.
  const Eigen::VectorXd& x() const { return x_; }
  // Half the sum of squares, prior included.
  double cost() const { return cost_; }
  void Start(const Eigen::VectorXd& x);

  // A Jacobian of all samples, its factor, the step and its cost, which is
  // halved as long as it does not go down. False where it cannot.
  bool Iterate();
  // Of the parameters' errors with noise of 1 and this prior, from a new
  // Jacobian and its factor.
  Eigen::MatrixXd Covariance() const;

  const Trajectory& trajectory() const { return trajectory_; }
  // Of the geometry, in the order of x.
  const std::vector<int>& refined() const { return refined_; }
  ArmGeometry Geometry(const Eigen::VectorXd& x) const;
  Robot WithInertia(const Eigen::VectorXd& x) const;

 private:
  // As many as tell what all samples do, the right side last.
  Eigen::MatrixXd Equations() const;
  double CostAt(const Eigen::VectorXd& x) const;

  Robot robot_;
  ArmGeometry geometry_;
  std::vector<int> refined_;  // the geometry's parameters, as in x
  Trajectory trajectory_;
  Eigen::VectorXd x_, prior_, weight_;
  double cost_ = 0;
};

}  // namespace armcal
