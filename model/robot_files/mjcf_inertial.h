#pragma once

#include <string>

#include "model/robot_files/mjcf_defaults.h"
#include "model/robot_files/mjcf_settings.h"
#include "model/robot_files/robot_tree.h"

namespace armcal {

// Sets the inertia of a <body>: that of its <inertial>, else, or always where
// the compiler says so, that of its geoms. What cannot be known without another
// file is link->inertial_error. Throws InputError.
void ReadMjcfInertial(const XmlElement& body, const std::string& childclass,
                      const MjcfDefaults& defaults,
                      const MjcfSettings& settings, TreeLink* link);

}  // namespace armcal
