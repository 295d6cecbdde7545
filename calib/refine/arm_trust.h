#pragma once

namespace armcal {

// How far the truth may reasonably be from the robot file: standard deviations
// of the prior.
struct ArmTrust {
  // Relative, in every direction of the links' pseudo-inertias.
  double inertia = 0.5;
  double length = 0.01;  // m
  double angle = 0.02;   // rad; also of the base's tilt
  // Of friction, offset and armature, whose torque at 1 rad/s and 1 rad/s^2 is
  // this many times what the joint's torque is: next to nothing, so that what
  // no motion shows stays finite.
  double joint_terms = 10;
};

}  // namespace armcal
