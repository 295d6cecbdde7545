#include "model/plant/hidden/neighbour_joint.h"

namespace armcal {

EffectSite NeighbourJoint(const EffectSite& site) {
  EffectSite any = site;
  for (const int joint : {site.joint - 1, site.joint + 1}) {
    if (joint < 0 || joint >= site.num_driven()) continue;
    any.joint = joint;
  }
  for (const int joint : {site.joint + 1, site.joint - 1}) {
    if (joint < 0 || joint >= site.num_driven()) continue;
    EffectSite same = site;
    same.joint = joint;
    if (same.type() == site.type()) return same;
  }
  return any;
}

std::string WhyNoNeighbour(const SimulatedRobot& robot, int /*joint*/) {
  return robot.robot.num_joints() - robot.num_passive > 1
             ? ""
             : "the robot has one joint";
}

}  // namespace armcal
