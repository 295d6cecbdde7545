#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/robot/inertial_parameters.h"
#include "model/robot/joint.h"
#include "model/robot/link_paths.h"

namespace armcal {

// Frames. X_AB is the pose of B in A, p_AB_C a position expressed in C; frames
// that are neighbours when multiplied match.
//   W  world, coincident with the frame of the fixed base link
//   P  the parent link's frame (W for the first link)
//   F  the joint's fixed frame on the parent: z along the joint axis
//   M  F moved by the joint (M = F at q = 0)
//   L  the link's frame; X_PL(q) = X_PF X_FM(q) X_ML
struct Link {
  std::string name;
  Joint joint;  // moves this link relative to its parent
  Eigen::Isometry3d X_PF = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d X_ML = Eigen::Isometry3d::Identity();
  InertialParameters inertial;  // about Lo, expressed in L
  bool has_inertial = false;    // false: the file gave none
  // Lengths of the DH table that are declared unknown: of "a", "d".
  std::vector<std::string> unknown_lengths;
  // Inertial parameters that are declared zero: of "hx".."Izz" by symmetry;
  // all ten, "mass" too, where the link is no body (DeclareMassless).
  std::vector<std::string> zero_inertials;

  Eigen::Isometry3d X_PL(double q) const;
};

// Says that the link is no body: it stands between two joints that move one, as
// in an MJCF body with two joints. Unlike a link whose file gives no inertia,
// its parameters are known, all to be 0.
void DeclareMassless(Link* link);
bool IsDeclaredMassless(const Link& link);

// Rz(yaw) Ry(pitch) Rx(roll) of rpy = (roll, pitch, yaw), as URDF means it.
Eigen::Matrix3d RotationFromRpy(const Eigen::Vector3d& rpy);

// The classical four parameters of a DH row (an input form). Standard (Paul):
// X_PL = Rz(theta) Tz(d) Tx(a) Rx(alpha). Modified (Craig):
// X_PL = Rx(alpha) Tx(a) Rz(theta) Tz(d). A revolute joint adds q to theta, a
// prismatic one to d. Units m and rad.
struct DhParameters {
  double a = 0;
  double d = 0;
  double alpha = 0;
  double theta = 0;
};
enum class DhConvention { kStandard, kModified };

// An open arm on a fixed base: its links from the base outwards, each with the
// joint that moves it. A serial arm is a chain; two arms on a torso, or fingers
// on a hand, branch.
struct Robot {
  std::string name;
  std::vector<Link> links;
  LinkParents parents;                                     // empty: a chain
  Eigen::Vector3d gravity{0, 0, -9.81};                    // in W, m/s^2
  Eigen::Isometry3d X_LT = Eigen::Isometry3d::Identity();  // tool on last link
  std::string tool_name;
  // Set where the robot was given as a DH table: which rows `a` belongs to.
  std::optional<DhConvention> dh_convention;
  // Where other joints of the file are held, whose bodies these links have: by
  // name, rad or m.
  std::map<std::string, double> held;
  // What the reader changed or dropped, a sentence each, for people to read.
  std::vector<std::string> notes;

  int num_joints() const { return static_cast<int>(links.size()); }
  bool branches() const { return !parents.empty(); }
  // The link that joint i sits on, -1 for the base.
  int parent(int i) const { return ParentOf(parents, i); }
  // The first joint that sits on link i, -1 where none does.
  int next(int i) const {
    return i + 1 < num_joints() && parent(i + 1) == i ? i + 1 : -1;
  }
  std::vector<std::string> JointNames() const;
};

// Sets link->X_PF and link->X_ML for link->joint.type from a DH row. For the
// standard convention F = P; for the modified one F is P moved by
// Rx(alpha) Tx(a).
void SetDhPose(const DhParameters& dh, DhConvention convention, Link* link);

}  // namespace armcal
