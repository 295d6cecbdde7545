#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

struct RobustRegression {
  Eigen::VectorXd x;
  Eigen::MatrixXd covariance;  // 0 in the rows and columns of what is not told
  // Whether a column adds to those that are told; x is 0 where it does not.
  Eigen::Array<bool, Eigen::Dynamic, 1> told;
  double noise = 0;  // 1.4826 times the median of what is left
  double rms = 0;    // of what is left
};

// y = A x in noise that follows itself and has outliers, by iteratively
// reweighted least squares: Huber's loss first, Tukey's at last
// (robust_loss.h). `follows`: whether a row is the next sample after the row
// before it. `prior`: of each column, the standard deviation of its x about 0;
// infinite: none.
RobustRegression FitRobustly(const Eigen::MatrixXd& A, const Eigen::VectorXd& y,
                             const std::vector<bool>& follows,
                             const Eigen::VectorXd& prior);

}  // namespace armcal
