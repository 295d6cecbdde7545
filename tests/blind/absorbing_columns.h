#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "tests/blind/model_residual.h"

namespace armcal {

// How far all torques may be shifted in time, s: one prior spread.
inline constexpr double kTimingSpread = 5e-4;

// Torques (thin, joints one below the other; a column each) of one prior
// spread of everything that the model may vary: each link's ten inertial
// parameters, armature, viscous and Coulomb friction and offset of each joint
// by the case's trust, the widths of zero velocity by a factor of e, the time
// of all torques (the last column) by kTimingSpread.
Eigen::MatrixXd AbsorbingColumns(const BlindCase& blind,
                                 const PlantMotion& motion);

// The fit of these columns, each with a standard normal prior, to whitened
// torques.
class Absorption {
 public:
  // `known`: information about the coefficients from elsewhere; may be empty.
  Absorption(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& known);

  // `known_gradient`: what that information says they are, times it.
  Eigen::VectorXd Coefficients(const Eigen::VectorXd& d,
                               const Eigen::VectorXd& known_gradient) const;
  // What of `d` is left when the columns are fitted to it.
  struct Left {
    Eigen::VectorXd residual;
    double squared;  // with the prior's cost
  };
  Left Of(const Eigen::VectorXd& d) const;

 private:
  Eigen::MatrixXd columns_;
  Eigen::LDLT<Eigen::MatrixXd> information_;
};

}  // namespace armcal
