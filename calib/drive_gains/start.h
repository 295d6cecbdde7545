#pragma once

#include <Eigen/Core>
#include <vector>

#include "problems/drive_gain_residual.h"

namespace armcal {

// What current equations are solved for, in the scale of g[reference] = 1:
// DriveGainResidual's g, x and p.
struct GainEstimate {
  Eigen::VectorXd g;  // n; 1 where the joint has no equations
  Eigen::VectorXd x;  // m
  Eigen::VectorXd p;  // 10
};

// Gains, up to their common scale, from the homogeneous linear equations
//   A (x + B p) - K_j z = 0,
// K_j = 1 / g_j, with errors in z alone (total least squares in K): the
// vector of gains for which the errors are smallest beside those that the
// currents' noise makes. Where several are as good (joints that share no
// inertia), the one nearest to `guess`. Then x and p from currents as left
// side. `rows`: how many equations each joint's were compressed from. The
// joint `reference` has equations.
GainEstimate StartGains(const std::vector<CurrentEquations>& equations,
                        const Eigen::MatrixXd& B, const Eigen::VectorXd& rows,
                        const Eigen::VectorXd& guess, int reference);

}  // namespace armcal
