#pragma once

#include <set>

#include "model/robot_files/mjcf/mjcf_defaults.h"
#include "model/robot_tree/robot_tree.h"
#include "model/text/xml_element.h"

namespace armcal {

// Where named things of an MJCF file stand, for what ties them to each other.
struct MjcfNames {
  LinkIndex bodies;
  LinkIndex sites, geoms;     // the link that each moves with
  LinkIndex joints;           // in RobotTree::joints
  std::set<int> mocap_links;  // moved by the simulation, not by the robot
};

// Adds what a file's <equality> and <tendon> sections say to
// RobotTree::couplings: equalities of bodies, sites and joints, and tendons
// with a spring, damping, friction, inertia, an actuator or an equality. What
// has no effect on motions, and what holds a body to one that only a simulation
// moves
// ("mocap"), is noted. Throws InputError.
void ReadMjcfCouplings(const XmlElement& root, const MjcfDefaults& defaults,
                       const MjcfNames& names, RobotTree* tree);

}  // namespace armcal
