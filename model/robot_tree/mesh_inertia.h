#pragma once

#include "model/robot/inertial_parameters.h"
#include "model/robot_tree/mesh_file.h"

namespace armcal {

// How the space within a surface is counted.
enum class MeshVolume {
  kExact,     // what the surface encloses; it has to be closed
  kAbsolute,  // MuJoCo's "legacy": every pyramid over a triangle counts, also
              // one that a hollow would take away
  kShell      // the surface itself, of 1 kg/m^2
};

// The body of density 1 within (kg/m^3; of kShell kg/m^2) the surface, about
// the origin of its points. A mass of 0 or less is no body's.
InertialParameters MeshInertia(const TriangleMesh& mesh, MeshVolume volume);

}  // namespace armcal
