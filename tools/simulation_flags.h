#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "model/dynamics/joint_controller.h"
#include "model/plant/reference_motion.h"
#include "model/robot/robot.h"
#include "tools/flag_values.h"

namespace armcal {

// The flags that commands which simulate share. Throw UsageError for a value
// that is not what the flag takes.
uint64_t SeedFromFlags(const FlagValues& flags);  // --seed
// --controller, or one that suits the motion (SteadyController).
ControllerOptions ControllerFromFlags(const FlagValues& flags,
                                      const Robot& robot,
                                      const ReferenceMotion& motion,
                                      double bandwidth_hz);

// One number for all of n joints, or one for each; none of them negative.
Eigen::VectorXd ParsePerJoint(const std::string& flag, const std::string& text,
                              int n);

}  // namespace armcal
