#pragma once

#include <vector>

#include "model/robot_tree/robot_tree.h"
#include "model/text/xml_element.h"

namespace armcal {

// Read one <link> or <joint>; `links` are the file's, `index` finds them. They
// throw InputError for names, types and links that are wrong; what is wrong
// with an inertia or a joint's frame, axis and numbers is the element's
// `error`.
TreeLink ReadUrdfLink(XmlElement element);
TreeJoint ReadUrdfJoint(XmlElement element, const std::vector<TreeLink>& links,
                        const LinkIndex& index);

}  // namespace armcal
