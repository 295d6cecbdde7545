#pragma once

#include "model/robot/robot.h"
#include "model/robot_tree/robot_reader_options.h"
#include "model/text/document.h"

namespace armcal {

// Reads a robot given in YAML, as a DH table or by the poses of its joints:
//
//   name: scara
//   gravity: [0, 0, 9.8]          # in the base frame, m/s^2
//   convention: standard          # or modified, see DhParameters; or poses
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
//       viscous: , coulomb: , armature: , offset:  # of the joint
//       unknown: [a, d]           # lengths to be estimated
//       zero: [hx, hy]            # inertial parameters zero by symmetry
//   tool: {x: , y: , z: , roll: , pitch: , yaw: }   # on the last link
//
// With convention poses, in place of a, d, alpha, theta and unknown:
//       pose: {xyz: [0, 0, 0.3], rpy: [0, 0, 0]}  # of the joint, on the
//                                 # parent, as URDF's origin; see ReadYamlPose
//       axis: [0, 0, 1]           # in the joint's frame, default z
//       link_pose: {xyz: , rpy: } # of the link, in the joint's moved frame
// With any: inertial: [m, hx, hy, hz, Ixx, Ixy, Iyy, Ixz, Iyz, Izz] about the
// link's origin in place of mass, com and inertia; tool: {name: , pose: {}}.
//
// Only convention, links and each link's joint are required; gravity defaults
// to 0 0 -9.81, a mass without inertia is a point mass. Unknown, duplicate and
// misspelt keys are refused, and --base and --tip. Throws InputError.
Robot ReadYaml(const Document& file, const RobotReaderOptions& options);

}  // namespace armcal
