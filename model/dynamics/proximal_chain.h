#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "model/robot/robot.h"

namespace armcal {

// A constant length between two joint axes: component 0 is the DH length a
// (along x of the proximal frame), component 2 the DH offset d (along z).
struct Length {
  int joint;         // 0-based; the length lies between the axes of this joint
  int next;          // and of the first that sits on its link
  int component;     // 0: a, 2: d
  double value;      // m, as the robot file has it
  std::string name;  // "a2": the DH symbol, 1-based
  std::string owner_name;  // "<link>.a": the row of the DH table it stands in
};

// One joint of a ProximalChain.
struct ProximalJoint {
  JointType type;
  double theta;            // rad, constant rotation about z after the motion
  Eigen::Isometry3d X_JG;  // C_i: pose of G_i in J of the joint before, at
                           // rest; of a first joint, the rotation to W alone
  Eigen::Isometry3d X_JL;  // the link's frame in J_i
};

// The arm as the paper's factorisation (2.5)-(2.8) sees it: for every joint a
// fixed frame G_i (z along the axis) and the proximal frame J_i, which is G_i
// moved by the joint and then turned by theta, its origin on the joint axis.
// Between J_i and G_{i+1} lies the constant C_{i+1}. J_i follows the DH
// convention (x along the common normal to the next axis), so that C_{i+1} =
// Tx(a) Tz(d) Rx(alpha); a robot read from a DH table keeps its table's
// lengths, another's x has the sense of z cross the next axis whatever the
// lengths are, so that a may be negative and arms that differ in lengths have
// the same frames. Axes less than 0.02 rad from parallel, where common normals
// run away, keep a general rotation and d = 0 (Hayati's remedy). Where several
// joints sit on one link, J_i follows the first; the others have general
// constants too.
struct ProximalChain {
  std::vector<ProximalJoint> joints;
  LinkParents parents;          // as the robot's
  Eigen::Vector3d gravity;      // in W, m/s^2
  std::vector<Length> lengths;  // all that can matter, also those that are 0
};

ProximalChain MakeProximalChain(const Robot& robot);

// Composite inertial parameters K_i of link i and what it carries about Ji,
// expressed in J_i, of the next joints' links with what does not depend on
// their own q only (docs/theory.md, 1): K_i = V_i + sum Sh(C_k) red(K_k) over
// the joints k that sit on link i.
std::vector<InertialParameters> CompositeInertials(const Robot& robot,
                                                   const ProximalChain& chain);

}  // namespace armcal
