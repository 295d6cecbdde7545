#pragma once

#include <vector>

#include "calib/numerics/block_triangular_factor.h"
#include "model/dynamics/joint_term.h"
#include "model/dynamics/model_parameters.h"

namespace armcal {

// The least width that a transition may have, rad(/s) or m(/s): a tenth of the
// sharpest that is looked for.
constexpr double kLeastTransition = 1e-9;

// The transitions of Coulomb friction that are tried on a joint: 18 velocities
// from 1e-3 to 0.3 rad/s and 15 displacements from 1e-4 to 2e-2 rad (m/s and m
// for a prismatic joint).
std::vector<CoulombTransition> CandidateTransitions();
// The largest width of them and of FinerTransitions, but for rounding.
double LargestTransition(CoulombTransition::Law law);

// Picks one transition per joint so that the weighted sum of squared residuals
// is least, from the factor of a model that has a Coulomb column for every
// candidate of every joint. Each candidate is judged by what it explains beyond
// all other columns (Frisch-Waugh), joint after joint, twice for each of three
// estimates of the joints' noise. Joints with noise[i] = 0 keep the first
// candidate. Returns the index among each joint's candidates.
std::vector<int> ChooseTransitions(const BlockTriangularFactor& factor,
                                   const ModelParameters& parameters,
                                   const Eigen::VectorXd& noise);

// A finer grid about one of CandidateTransitions(): 9 widths of its law up to
// its neighbours on either side; from the least of them 25, down to 1e-4 of it.
std::vector<CoulombTransition> FinerTransitions(
    const CoulombTransition& coarse);

// Like ChooseTransitions on finer grids, with the width between the grid's
// where a parabola through the three best has its top.
std::vector<CoulombTransition> RefineTransitions(
    const BlockTriangularFactor& factor, const ModelParameters& parameters,
    const Eigen::VectorXd& noise);

}  // namespace armcal
