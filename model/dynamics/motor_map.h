#pragma once

#include <Eigen/Core>
#include <functional>

#include "model/dynamics/simulated_robot.h"

namespace armcal {

// The law of an ActuatorMap (simulated_robot.h) of one motor, without states
// and whatever else the arm does: what it gives of a command, N m or N, while
// its joint moves at this velocity, rad/s or m/s. It is a class of its own so
// that whoever inverts maps knows it again (ActuatorMap::apply.target).
struct MotorMap {
  int joint = 0;
  std::function<double(double commanded, double velocity)> given;
  // Its inverse at any velocity: the command for which it gives this. Empty
  // where a command is lost, as at a limit.
  std::function<double(double given)> commanded;

  void operator()(const ArmInstant& instant, const double*, double*,
                  Eigen::VectorXd* torque) const {
    (*torque)[joint] = given((*torque)[joint], instant.velocity[joint]);
  }
};

}  // namespace armcal
