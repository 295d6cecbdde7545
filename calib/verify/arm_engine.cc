#include "calib/verify/arm_engine.h"

#include <algorithm>

#include "model/dynamics/rigid_arm.h"
#include "model/plant/simbody_arm.h"
#include "model/text/input_error.h"

namespace armcal {
namespace {

// Simbody takes some of them and fails in a pose that it reaches later.
bool HasImpossibleLink(const Robot& robot) {
  return std::any_of(
      robot.links.begin(), robot.links.end(), [](const Link& link) {
        const InertialParameters& body = link.inertial;
        return !body.ToVector().isZero(0) && !WhyUnphysical(body).empty();
      });
}

}  // namespace

ArmEngine MakeArmEngine(const Robot& robot) {
  if (HasImpossibleLink(robot)) {
    return {std::make_unique<RigidArm>(robot), false};
  }
  try {
    return {std::make_unique<SimbodyArm>(robot), true};
  } catch (const InputError&) {  // VerifyDynamics() tells of it
    return {std::make_unique<RigidArm>(robot), false};
  }
}

}  // namespace armcal
