#pragma once

#include <Eigen/Core>

#include "model/dynamics/arm_dynamics.h"
#include "model/dynamics/simulated_robot.h"

namespace armcal {

// Where things are in the state vector of a SimulatedRobot: link positions and
// velocities first, then position and velocity of each transmission's motor,
// the states that laws carry along, temperatures.
struct SimulatorLayout {
  int motors = 0;
  int joint_laws = 0, transmissions = 0, wrenches = 0, actuators = 0;
  int temperature = 0;
  int size = 0;

  explicit SimulatorLayout(const SimulatedRobot& robot);
  // At rest with the links at q0 (n): motors where their transmission carries
  // gravity; `terms` are the engine's at q0.
  Eigen::VectorXd StateAtRest(const SimulatedRobot& robot,
                              const Eigen::VectorXd& q0,
                              const ArmTerms& terms) const;
};

}  // namespace armcal
