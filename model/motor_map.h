#pragma once

#include <Eigen/Core>
#include <functional>

#include "model/simulated_robot.h"

namespace armcal {

// The law of an ActuatorMap (simulated_robot.h) of one motor, without states
// and whatever the arm does: what it gives of a command, N m or N, less a share
// of what a neighbour is asked for. It is a class of its own so that whoever
// inverts maps knows it again (ActuatorMap::apply.target).
struct MotorMap {
  int joint = 0;
  std::function<double(double commanded)> given;
  int neighbour = 0;  // another joint
  double share = 0;   // of its command

  // Torques of all joints: a vector, or a row of samples x n.
  template <class Torques>
  double FromNeighbour(const Torques& torque) const {
    return share == 0 ? 0 : share * torque[neighbour];
  }
  void operator()(const ArmInstant&, const double*, double*,
                  Eigen::VectorXd* torque) const {
    (*torque)[joint] = given((*torque)[joint]) - FromNeighbour(*torque);
  }
};

}  // namespace armcal
