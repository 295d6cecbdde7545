#include "model/plant/hidden/joint_friction.h"

#include <glog/logging.h>

#include "model/plant/hidden/hidden_effect.h"
#include "model/plant/hidden/zero_velocity.h"

namespace armcal {

void AddJointFriction(double zero_velocity, SimulatedRobot* robot) {
  CHECK_GT(zero_velocity, 0);
  const int n = robot->robot.num_joints();
  for (int j = robot->num_passive; j < n; ++j) {
    const Joint& joint = robot->robot.links[j].joint;
    const double viscous = joint.viscous, coulomb = joint.coulomb;
    const double offset = joint.offset;
    const double width =
        IsRotational(joint.type) ? zero_velocity : .3 * zero_velocity;
    const int k = n - j;
    if (viscous != 0 || coulomb != 0) {
      robot->joint_laws.push_back(
          {j, {}, true, [=](const ArmInstant& at, const double*, double*) {
             const double v = FromTip(at.velocity, k);
             return -viscous * v - coulomb * ZeroVelocitySign(v, width);
           }});
    }
    if (offset == 0) continue;
    robot->joint_laws.push_back(
        {j, {}, false, [=](const ArmInstant&, const double*, double*) {
           return -offset;
         }});
  }
}

}  // namespace armcal
