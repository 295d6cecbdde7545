#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/poses/diagnosis/equations.h"
#include "calib/poses/diagnosis/student.h"

namespace armcal {

// An arm's geometry, its instrument and amounts of terms, fitted by least
//   -2 log p(measured) - 2 log p(geometry) - 2 log p(amounts)
// with Student's t of the errors, the file's prior of the geometry, and what
// else has told amounts.
struct PoseEstimate {
  PoseState state;
  StudentFit errors;
  double nu = 0;          // degrees of freedom of the errors
  double prior = 0;       // -2 log p of the priors, but for a constant
  Eigen::VectorXd told;   // 1 / variance of what else has told each amount
  double parameters = 0;  // effective number of the geometry's
  LinearPoses linear;     // there
  double Cost() const { return errors.deviance + prior; }
};

PoseEstimate EstimatePoses(const PoseEquations& equations,
                           const std::vector<PoseTerm>& terms, double nu,
                           const PoseState& start);

// Half the derivative of -2 log p of the priors by geometry and amounts.
Eigen::VectorXd PriorPull(const PoseEquations& equations,
                          const std::vector<PoseTerm>& terms,
                          const PoseState& at);
// J'WJ / s^2 and the prior of the unknowns, geometry first, then `columns`: of
// no term, or of those of `at`.
Eigen::MatrixXd PoseInformation(const PoseEquations& equations,
                                const PoseEstimate& at,
                                const Eigen::MatrixXd& columns);
// The equations' rows times the root of their pose's weight over the scale.
Eigen::MatrixXd WeightedRows(const PoseEstimate& at,
                             const Eigen::MatrixXd& rows);

}  // namespace armcal
