#pragma once

#include "model/robot_tree/robot_tree.h"
#include "model/text/xml_element.h"

namespace armcal {

// What a URDF file says that ties joints of its tree to each other: <mimic>,
// and joints that close loops, which URDF itself has not: Drake's <loop_joint>,
// and SDF's <joint> in a <gazebo> element. Throws InputError for
// a loop of unknown links.
void ReadUrdfCouplings(const XmlElement& root, const LinkIndex& links,
                       RobotTree* tree);

}  // namespace armcal
