#pragma once

#include "model/robot_tree/robot_tree.h"
#include "model/text/xml_element.h"

namespace armcal {

// Reads the inertia of `link` from its element <link>. What that does not say
// is not zero in SDF: a link without <inertial> has 1 kg and moments of 1 kg
// m^2 about its origin, and so has an <inertial> without <mass> or <inertia>
// (SDFormat specification, link.sdf and inertial.sdf; libsdformat, and with it
// Gazebo and Drake, simulates such links). The link gets a note of what was
// taken so. Throws InputError.
void ReadSdfInertial(const XmlElement& element, TreeLink* link);

}  // namespace armcal
