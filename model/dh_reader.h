#pragma once

#include <string>

#include "model/robot_reader.h"

namespace armcal {

// Reads a robot given as a DH table in YAML:
//
//   name: scara
//   gravity: [0, 0, 9.8]          # in the base frame, m/s^2
//   convention: standard          # or modified; see DhParameters
//   links:                        # base to tip
//     - name: upper_arm           # optional: link1, link2, ...
//       joint: revolute           # or continuous, prismatic
//       joint_name: shoulder      # optional: joint1, joint2, ...
//       a: 0.4                    # m; a, d, alpha, theta default to 0
//       d: 0
//       alpha: 0                  # rad
//       theta: 0                  # rad, offset of a revolute joint
//       mass: 5                   # kg
//       com: [x, y, z]            # m, in the link frame
//       inertia: [Ixx, Ixy, Iyy, Ixz, Iyz, Izz]  # about the com, kg m^2; or
//                                 # [Ixx, Iyy, Izz]
//       limits: {lower: , upper: , velocity: , effort: }
//       viscous: , coulomb: , armature:          # of the joint
//       unknown: [a, d]           # lengths to be estimated
//       zero: [hx, hy]            # inertial parameters zero by symmetry
//   tool: {x: , y: , z: , roll: , pitch: , yaw: }   # on the last link
//
// Only convention, links and each link's joint are required; gravity defaults
// to 0 0 -9.81, a mass without inertia is a point mass. Unknown, duplicate and
// misspelt keys are refused, and --base and --tip. Throws InputError.
Robot ReadDhTable(const std::string& path, const RobotReaderOptions& options);

}  // namespace armcal
