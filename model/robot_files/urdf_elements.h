#pragma once

#include <vector>

#include "model/robot_files/robot_tree.h"
#include "model/text/xml_element.h"

namespace armcal {

// Read one <link> or <joint>. They throw InputError for whatever the element
// and its children have wrong; `links` are the file's, `index` finds them.
TreeLink ReadUrdfLink(XmlElement element);
TreeJoint ReadUrdfJoint(XmlElement element, const std::vector<TreeLink>& links,
                        const LinkIndex& index);

}  // namespace armcal
