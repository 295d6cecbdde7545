#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

struct RobustRegression {
  Eigen::VectorXd x;
  Eigen::MatrixXd covariance;  // 0 in the rows and columns of what is not told
  // Whether x is the column's own: of columns that are combinations of each
  // other some are fitted for all.
  Eigen::Array<bool, Eigen::Dynamic, 1> told;
  double noise = 0;  // 1.4826 times the median of what is left
  double rms = 0;    // of what is left
  // Of what is left but for a tenth of gross errors: its 90 % quantile over
  // that of a standard normal.
  double spread = 0;
};

// y = A x, of rows that follow each other in time.
struct RegressionRows {
  Eigen::MatrixXd A;
  // Columns whose noise is not A's, in its place: in the normal equations
  // Z'A x = Z'y noise of A's columns then draws nothing towards 0 (instrumental
  // variables: Durbin 1954).
  Eigen::MatrixXd Z;
  Eigen::VectorXd y;
  std::vector<bool> follows;  // a row is the next sample after the one before
  // Of each column, the standard deviation of its x about 0; infinite: none.
  Eigen::VectorXd prior;
};

// In noise that follows itself and has outliers, by iteratively reweighted
// least squares: Huber's loss first, Tukey's at last (robust_loss.h).
RobustRegression FitRobustly(const RegressionRows& rows);

}  // namespace armcal
