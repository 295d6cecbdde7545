#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "model/robot/robot.h"

namespace armcal {

// A constant length between two joint axes: component 0 is the DH length a
// (along x of the proximal frame), component 2 the DH offset d (along z).
struct Length {
  int joint;      // 0-based; the length lies between axes joint and joint + 1
  int component;  // 0: a, 2: d
  double value;   // m, as the robot file has it
  std::string name;        // "a2": the DH symbol, 1-based
  std::string owner_name;  // "<link>.a": the row of the DH table it stands in
};

// One joint of a ProximalChain.
struct ProximalJoint {
  JointType type;
  double theta;            // rad, constant rotation about z after the motion
  Eigen::Matrix3d R;       // C_i = (R, p): pose of G_{i+1} in J_i at rest;
  Eigen::Vector3d p;       // identity for the last joint
  Eigen::Isometry3d X_JL;  // the link's frame in J_i
};

// The arm as the paper's factorisation (2.5)-(2.8) sees it: for every joint a
// fixed frame G_i (z along the axis) and the proximal frame J_i, which is G_i
// moved by the joint and then turned by theta, its origin on the joint axis.
// Between J_i and G_{i+1} lies the constant C_i. J_i follows the DH convention
// (x along the common normal to the next axis), so that C_i = Tx(a) Tz(d)
// Rx(alpha); a robot read from a DH table keeps its table's lengths, another's
// x has the sense of z cross the next axis whatever the lengths are, so that a
// may be negative and arms that differ in lengths have the same frames. Axes
// less than 0.02 rad from parallel, where common normals run away, keep a
// general rotation R and d = 0 (Hayati's remedy).
struct ProximalChain {
  std::vector<ProximalJoint> joints;
  Eigen::Vector3d gravity;      // expressed in G_1, m/s^2
  std::vector<Length> lengths;  // all that can matter, also those that are 0
};

ProximalChain MakeProximalChain(const Robot& robot);

// Composite inertial parameters K_i of links i..n about Ji, expressed in J_i,
// with what does not depend on q_{i+1} only (docs/theory.md, 1):
// K_i = V_i + Sh(C_i) red(K_{i+1}).
std::vector<InertialParameters> CompositeInertials(const Robot& robot,
                                                   const ProximalChain& chain);

}  // namespace armcal
