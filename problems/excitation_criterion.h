#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace armcal {

// What of a covariance is to be small.
enum class ExcitationCriterion {
  kD,     // the volume of the confidence ellipsoid
  kA,     // the sum of variances
  kWorst  // the largest standard deviation
};

// Quantities theta that the model parameters X(theta) follow from, and which of
// them matter.
struct DesignQuantities {
  Eigen::MatrixXd J;      // dX / dtheta, m x size
  Eigen::MatrixXd known;  // information about theta beforehand, size x size
  std::vector<int> wanted;
  // By which standard deviations of the wanted are measured, in theirs units.
  Eigen::VectorXd scale;
};

// The criterion as a logarithm of a standard deviation relative to the scale:
// D: log det / 2 of the wanted's covariance over their number; A: of the root
// of the mean square; worst: of the 12-norm, which is smooth. Nothing where the
// information (m x m) leaves a quantity open. `of_A`: its gradient in the
// information.
std::optional<double> EvaluateCriterion(ExcitationCriterion criterion,
                                        const DesignQuantities& quantities,
                                        const Eigen::MatrixXd& A,
                                        Eigen::MatrixXd* of_A);

// Standard deviations of all quantities; infinite where open.
Eigen::VectorXd PredictedStddev(const DesignQuantities& quantities,
                                const Eigen::MatrixXd& A);

}  // namespace armcal
