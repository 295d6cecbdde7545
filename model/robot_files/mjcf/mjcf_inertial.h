#pragma once

#include <vector>

#include "model/robot_files/mjcf/mjcf_defaults.h"
#include "model/robot_files/mjcf/mjcf_meshes.h"
#include "model/robot_files/mjcf/mjcf_parts.h"
#include "model/robot_files/mjcf/mjcf_settings.h"
#include "model/robot_tree/robot_tree.h"

namespace armcal {

// Sets the inertia of a body with these parts: that of its <inertial>, else,
// or always where the compiler says so, that of its geoms. Throws InputError.
void ReadMjcfInertial(const XmlElement& body,
                      const std::vector<MjcfPart>& parts,
                      const MjcfDefaults& defaults,
                      const MjcfSettings& settings, MjcfMeshes* meshes,
                      TreeLink* link);

}  // namespace armcal
