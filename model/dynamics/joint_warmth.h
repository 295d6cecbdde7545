#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/dynamics/simulated_robot.h"

namespace armcal {

// How much warmer than their surroundings joints are, K, that start cold and
// are heated by `power` (W, samples x n, dt s apart), linear in between:
// capacity T' = power - T / resistance, exactly. n x samples.
Eigen::MatrixXd JointWarmth(const Eigen::MatrixXd& power, double dt,
                            const std::vector<JointThermal>& thermal);

// The capacity and resistance with which a joint heated by `power` (W) would
// have been as warm as `warmth` says (K, whatever its zero is), both recorded
// dt s apart; the usual ones where its warmth does not follow its power.
JointThermal FitThermal(const Eigen::VectorXd& power,
                        const Eigen::VectorXd& warmth, double dt);

}  // namespace armcal
