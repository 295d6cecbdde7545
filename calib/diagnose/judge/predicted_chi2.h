#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/data/baseline_columns.h"
#include "calib/diagnose/data/screen.h"

namespace armcal {

// chi^2 of residuals of data that a fit has not seen. They differ from 0 by
// their noise and by the errors of the fit's values alike, which elsewhere may
// be far larger than where it was fitted:
//   chi^2 = r' (I + X C X')^-1 r
//         = r'r - s' L (I + L' X'X L)^-1 L' s,   s = X'r, C = L L',
// with whitened rows r, the columns X of the fit and the covariance C of its
// values (Gelman et al., Bayesian Data Analysis, 2013, 14.2: the posterior
// predictive distribution of a regression).
class PredictedChi2 {
 public:
  // Of whitened rows; of all columns' values.
  PredictedChi2(std::vector<BaselineColumns> columns,
                const Eigen::MatrixXd& covariance);

  // Whitened residuals per joint.
  double Of(const JointRows& residual) const;

 private:
  std::vector<BaselineColumns> columns_;  // per joint
  Eigen::MatrixXd half_;                  // M' M = L (I + L' X'X L)^-1 L'
};

}  // namespace armcal
