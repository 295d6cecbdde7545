#include "model/plant/hidden/neighbour_joint.h"

namespace armcal {

EffectSite NeighbourJoint(const EffectSite& site) {
  const Robot& robot = site.robot->robot;
  const int passive = site.robot->num_passive;
  EffectSite any = site;
  bool has_any = false;
  for (const int link :
       {robot.next(site.index()), robot.parent(site.index())}) {
    if (link < passive) continue;
    EffectSite same = site;
    same.joint = link - passive;
    if (same.type() == site.type()) return same;
    if (!has_any) any = same;
    has_any = true;
  }
  return any;
}

std::string WhyNoNeighbour(const SimulatedRobot& robot, int joint) {
  const int link = robot.num_passive + joint;
  const bool alone = robot.robot.next(link) < 0 &&
                     robot.robot.parent(link) < robot.num_passive;
  return alone ? "the robot has one joint" : "";
}

}  // namespace armcal
