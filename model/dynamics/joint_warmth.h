#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/dynamics/simulated_robot.h"

namespace armcal {

// What cold joints' friction heats them with, W, samples x n each.
struct FrictionPower {
  Eigen::MatrixXd viscous, coulomb;
};

// How much warmer than their surroundings joints are, K, that start cold and
// are heated by their friction, known dt s apart and linear in between:
//   capacity T' = viscous exp(-viscous_fall T) + coulomb exp(-coulomb_fall T)
//                 - T / resistance,
// exactly where nothing falls, else with the T of a sample before in what is
// left of friction. n x samples.
Eigen::MatrixXd JointWarmth(const FrictionPower& power, double dt,
                            const std::vector<JointThermal>& thermal);

// The capacity and resistance with which a joint heated by `power` (W) would
// have been as warm as `warmth` says (K, whatever its zero is), both recorded
// dt s apart; the usual ones where its warmth does not follow its power.
JointThermal FitThermal(const Eigen::VectorXd& power,
                        const Eigen::VectorXd& warmth, double dt);

}  // namespace armcal
