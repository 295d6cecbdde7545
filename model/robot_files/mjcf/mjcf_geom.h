#pragma once

#include "model/robot/inertial_parameters.h"
#include "model/robot_files/mjcf/mjcf_defaults.h"
#include "model/robot_files/mjcf/mjcf_meshes.h"
#include "model/robot_files/mjcf/mjcf_settings.h"

namespace armcal {

// A geom's body: solid, of its mass or density (1000 kg/m^3), about the origin
// of the frame that it stands in. Spheres, capsules, cylinders, boxes and
// ellipsoids, and meshes, whose files are read; planes and what has no mass are
// none. Throws InputError, also for a height field or SDF with mass.
InertialParameters ReadMjcfGeom(const MjcfElement& geom,
                                const MjcfSettings& settings,
                                MjcfMeshes* meshes);

}  // namespace armcal
