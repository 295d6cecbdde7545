#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/simulated_robot.h"

namespace armcal {

// How much warmer than their surroundings joints are, K, that start cold and
// are heated by `power` (W, samples x n, dt s apart), linear in between:
// capacity T' = power - T / resistance, exactly. n x samples.
Eigen::MatrixXd JointWarmth(const Eigen::MatrixXd& power, double dt,
                            const std::vector<JointThermal>& thermal);

}  // namespace armcal
