#include "calib/arm_engine.h"

#include "model/input_error.h"
#include "model/plant/simbody_arm.h"
#include "model/rigid_arm.h"

namespace armcal {

ArmEngine MakeArmEngine(const Robot& robot) {
  try {
    return {std::make_unique<SimbodyArm>(robot), true};
  } catch (const InputError&) {  // Verify() tells of it
    return {std::make_unique<RigidArm>(robot), false};
  }
}

}  // namespace armcal
