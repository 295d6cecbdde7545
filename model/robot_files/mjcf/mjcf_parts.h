#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "model/robot_files/mjcf/mjcf_defaults.h"
#include "model/robot_files/mjcf/mjcf_settings.h"
#include "model/text/xml_element.h"

namespace armcal {

// A child of a body, out of the <frame> elements that it stands in: they move
// what is in them and may give it a default class, and are no bodies.
struct MjcfPart {
  XmlElement element;
  Eigen::Isometry3d X_BF = Eigen::Isometry3d::Identity();  // of its frame
  std::string childclass;
};

// The children of <body> or <worldbody>, in their order. Throws InputError.
std::vector<MjcfPart> ReadMjcfParts(const XmlElement& body,
                                    const std::string& childclass,
                                    const MjcfDefaults& defaults,
                                    const MjcfSettings& settings);

}  // namespace armcal
