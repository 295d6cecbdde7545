#pragma once

#include <vector>

#include "model/robot_files/mjcf_defaults.h"
#include "model/robot_files/mjcf_meshes.h"
#include "model/robot_files/mjcf_parts.h"
#include "model/robot_files/mjcf_settings.h"
#include "model/robot_files/robot_tree.h"

namespace armcal {

// Sets the inertia of a body with these parts: that of its <inertial>, else,
// or always where the compiler says so, that of its geoms. Throws InputError.
void ReadMjcfInertial(const std::vector<MjcfPart>& parts,
                      const MjcfDefaults& defaults,
                      const MjcfSettings& settings, MjcfMeshes* meshes,
                      TreeLink* link);

}  // namespace armcal
