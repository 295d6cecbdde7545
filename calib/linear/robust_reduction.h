#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/linear/row_reduction.h"
#include "calib/numerics/robust_rows.h"
#include "problems/robust_loss.h"

namespace armcal {

// The joints' equations U x = y about some parameters, weighted by a robust
// loss of their residuals there and compressed to a triangular factor per
// joint, on all threads: the same bits for any number of them.
class RobustReduction {
 public:
  struct Point {
    Eigen::VectorXd x;
    // So many last columns are derivatives at x of torques that are not linear
    // in these parameters: of x they make no torque, but of what changes.
    int nonlinear = 0;
    Eigen::VectorXd noise;  // per joint, of a row
    RobustLoss loss = RobustLoss::kSquared;
    bool with_spread = true;  // whether it is asked for
  };
  // Rows that functions with these columns will have.
  RobustReduction(const Point& at, const MotionFunctions& functions,
                  long leaf_rows);

  // Joints' equations that are not `used` have the weight 0.
  void Add(const IdentificationRows& rows, const std::vector<bool>& used);

  // All equations in units of the noise: upper triangle of x.size() + 1, the
  // right side last and such that x is what solves them.
  Eigen::MatrixXd Triangle() const;
  // Of residuals in units of the noise, and only of used equations.
  const ResidualSpread& spread(int joint) const { return spreads_[joint]; }

 private:
  void WeighJoint(const ReducedRows& rows, int joint, bool used);

  Point at_;
  std::vector<std::vector<int>> columns_;  // of each joint
  RowReduction reduction_;
  std::vector<TriangularFactor> factors_;
  std::vector<std::vector<std::vector<double>>> residuals_;  // [slot][joint]
  std::vector<ResidualSpread> spreads_;
};

}  // namespace armcal
