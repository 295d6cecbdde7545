#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/dynamics/model_parameters.h"

namespace armcal {

struct RecoveredLength {
  std::string name;    // "<link>.a", the row of the DH table
  std::string symbol;  // "a2"
  double nominal;      // m, the robot file's
  double value;        // m
  double stddev;       // m
  // False where only products with moments or sums of lengths are seen: then
  // values are those nearest to the robot file's of all that fit as well.
  bool identifiable;
};

// The unknown lengths from estimated model parameters: every first moment
// appears alone and times each length with the same lengths throughout (a
// rank-one array: docs/theory.md, 1), so X = M X_full(moments, lengths) is
// fitted by Gauss-Newton from a linear start that needs no nominal lengths. The
// weight is `independent`, the covariance of X had the equations independent
// errors, whose structure is known well; the standard deviations are those that
// the fit makes of `covariance` (a sandwich), which as a matrix is too noisy to
// be inverted. Parameters not `usable` are left out.
std::vector<RecoveredLength> RecoverLengths(const ModelParameters& parameters,
                                            const Eigen::VectorXd& x,
                                            const Eigen::MatrixXd& independent,
                                            const Eigen::MatrixXd& covariance,
                                            const std::vector<bool>& usable);

}  // namespace armcal
