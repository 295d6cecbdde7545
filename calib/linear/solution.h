#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/linear/identifiability.h"
#include "calib/linear/options.h"
#include "calib/numerics/block_triangular_factor.h"

namespace armcal {

// A solution of the linear equations, and how errors of the equations reach
// it: x - X = gain * sum over rows of their scores, where the score of a row is
// the sum over joints of weight_i u_i' (y_i - u_i X), u_i restricted to joint
// i's own block for the recursion. The gain carries errors of later blocks up
// the triangle.
struct LinearSolution {
  bool solved = false;
  std::string refusal;  // why not
  Eigen::VectorXd x;
  Eigen::MatrixXd gain;    // m x m
  Eigen::VectorXd weight;  // per joint
  // d x / d e_i where all of joint i's right sides are 1 + e_i times as large,
  // m x n: what a wrong torque constant does. The columns' sum is x.
  Eigen::MatrixXd by_scale;
  bool weighted = false;  // by the joints' noise
  bool own_block_only = false;
  std::vector<bool> identifiable;  // per parameter

  // The covariance of x where equations have independent errors of standard
  // deviation noise[i].
  Eigen::MatrixXd IndependentCovariance(const BlockTriangularFactor& factor,
                                        const Eigen::VectorXd& noise) const;
  // The covariance of x from that of the scores' sum.
  Eigen::MatrixXd CovarianceFromScores(const Eigen::MatrixXd& scores) const;
};

// noise[i] = 0 leaves joint i's equations out. Directions that the data cannot
// see stay at zero (in the metric of WeightedSystem).
LinearSolution SolveWeighted(const BlockTriangularFactor& factor,
                             const Eigen::VectorXd& noise,
                             const ReferenceScale& reference);
// The paper's (2.25): SolveWeighted with equal noise.
LinearSolution SolveBatch(const BlockTriangularFactor& factor,
                          const ReferenceScale& reference);
// The paper's (2.28), refused where (2.30) fails for a block.
LinearSolution SolveRecursive(const BlockTriangularFactor& factor,
                              const Identifiability& identifiability);

// Standard deviation of each joint's equations at x, from the factor alone,
// corrected for the parameters spent; at least 1e-9 of the right side's rms.
Eigen::VectorXd EstimateNoise(const BlockTriangularFactor& factor,
                              const Eigen::VectorXd& x);

// Weighted solution with noise re-estimated until it stays (2 %), at most 20
// times. `excluded` joints keep noise[i] as it is.
LinearSolution SolveReweighted(const BlockTriangularFactor& factor,
                               const ReferenceScale& reference,
                               const std::vector<bool>& excluded,
                               Eigen::VectorXd* noise);

}  // namespace armcal
