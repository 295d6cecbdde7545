#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/data/baseline_columns.h"
#include "calib/diagnose/data/screen.h"

namespace armcal {

// chi^2 of residuals of data that a fit has not seen. They differ from 0 by
// their noise and by the errors of the fit's values alike, which elsewhere may
// be far larger than where it was fitted:
//   chi^2 = r' (I + X N^-1 X')^-1 r
//         = r'r - s' (N + X'X)^-1 s,   s = X'r,
// with whitened rows r, the columns X of the fit and the information N on its
// values, the inverse of their covariance (Gelman et al., Bayesian Data
// Analysis, 2013, 14.2: the posterior predictive distribution of a
// regression).
class PredictedChi2 {
 public:
  // Of whitened rows; of all columns' values.
  PredictedChi2(std::vector<BaselineColumns> columns,
                Eigen::MatrixXd information);

  // Whitened residuals per joint.
  double Of(const JointRows& residual) const;

 private:
  std::vector<BaselineColumns> columns_;  // per joint
  Eigen::LLT<Eigen::MatrixXd> both_;      // N + X'X
};

}  // namespace armcal
