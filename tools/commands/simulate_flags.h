#pragma once

#include "model/dynamics/joint_controller.h"
#include "model/plant/hidden/scenario.h"
#include "tools/command.h"

namespace armcal {

// What is chosen for the arm where flags do not say it.
struct UsualLoop {
  double bandwidth_hz = kUsualBandwidthHz;
  double speed = 1;  // share of the motion's
};

// The robot, motion, sensors and hidden effects that the flags of armcal
// simulate ask for. Throws UsageError and InputError.
Scenario ScenarioFromFlags(const CommandInput& input,
                           const UsualLoop& loop = {});

}  // namespace armcal
