#pragma once

#include "model/robot/inertial_parameters.h"
#include "model/robot_files/mjcf_defaults.h"
#include "model/robot_files/mjcf_settings.h"

namespace armcal {

// A geom's body: solid, of its mass or density (1000 kg/m^3), about the origin
// of the frame that it stands in. Spheres, capsules, cylinders, boxes and
// ellipsoids; planes and what has no mass are none. Throws InputError, also for
// a mesh or height field with mass, which is another file's.
InertialParameters ReadMjcfGeom(const MjcfElement& geom,
                                const MjcfSettings& settings);

}  // namespace armcal
