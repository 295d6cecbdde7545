#pragma once

namespace armcal {

// What acts on a joint beside what a Joint has.
struct JointDrive {
  // A spring pushes with -stiffness (q - rest); N m/rad or N/m, rad or m.
  double stiffness = 0;
  double rest = 0;
  // Torque that the motor gives per torque that is asked of it.
  double gain = 1;
};

}  // namespace armcal
