#pragma once

#include <memory>

#include "model/dynamics/arm_dynamics.h"
#include "model/robot/robot.h"

namespace armcal {

// A robot's rigid dynamics by Simbody or, where a link cannot exist or Simbody
// refuses it, by our own.
struct ArmEngine {
  std::unique_ptr<ArmDynamics> dynamics;
  bool is_simbody;
};
ArmEngine MakeArmEngine(const Robot& robot);

}  // namespace armcal
