#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "model/robot/inertial_parameters.h"
#include "model/robot/joint.h"
#include "model/text/input_error.h"

namespace armcal {

// The links and joints of a robot file as they stand there, before a chain is
// chosen. They refer to each other by index; -1 is none.
struct TreeLink {
  std::string name;
  int line = 0;
  InertialParameters inertial;  // about Lo, expressed in L
  bool has_inertial = false;
  // What is wrong with it: thrown where the robot has this link, noted where it
  // has not.
  std::optional<InputError> error;
  int parent_joint = -1;
  std::vector<int> child_joints;
  std::vector<std::string> notes;  // for Robot::notes, if the robot has it
  bool is_held = false;  // a joint that is held puts it where it is: optional
  // A frame that the file names on a link, no body: the tool where its name is
  // asked for, or where it is all that stands on the last link.
  bool is_frame = false;
  // Between two joints of one body, as MJCF has them: no body either, so that
  // its mass is known to be 0. A link without inertial may have any.
  bool is_massless = false;
};

// A joint's position as that of another: factor * q + offset.
struct TreeMimic {
  int leader = -1;
  double factor = 1;
  double offset = 0;  // rad or m
};

// The child's pose on its parent is X_PJ, then the joint's motion about or
// along `axis`, then X_JL.
struct TreeJoint {
  std::string type;  // as in the file
  int line = 0;
  bool is_fixed = false;
  bool is_supported = false;        // one of JointType
  std::optional<InputError> error;  // as that of a link
  Joint joint;  // of a fixed or unsupported joint only the name
  std::optional<TreeMimic> mimic;
  int parent = -1;
  int child = -1;
  Eigen::Isometry3d X_PJ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d X_JL = Eigen::Isometry3d::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  // in J, unit length
  std::vector<std::string> notes;
};

// What ties joints to each other, or to the world, beside the tree: a loop that
// is closed, a joint that follows another, a tendon. Then the torque of one is
// not its own, and the motions of several not independent.
struct TreeCoupling {
  std::string what;  // "line 12, equality <connect> 'rod'"
  std::vector<int> joints;
};

using LinkIndex = std::unordered_map<std::string, int>;  // by name

struct RobotTree {
  std::string name;
  std::vector<TreeLink> links;
  std::vector<TreeJoint> joints;
  std::vector<TreeCoupling> couplings;
  std::vector<int> roots;  // links without a parent joint, at least one
  Eigen::Vector3d gravity{0, 0, -9.81};  // in the roots' frame, m/s^2
  std::vector<std::string> notes;        // of the file as a whole
  // What is_supported or is_fixed, in the file's words, for messages.
  std::string joint_types = "a revolute, continuous, prismatic or fixed joint";

  std::optional<int> FindLink(const std::string& name) const;
  // The joints that move `link` relative to its root, the nearest first.
  std::vector<int> JointsAbove(int link) const;
  // Those that move one of the two links relative to the other: what connects
  // these closes a loop over them.
  std::vector<int> JointsBetween(int link, int other) const;
};

// A link's mass (kg) and inertia about the centre of mass, which is the origin
// of the frame I (kg m^2, in I). Mass 0 is none; an inertia that no rigid body
// has is taken. Both with a note.
void SetInertial(double mass, const Eigen::Matrix3d& inertia,
                 const Eigen::Isometry3d& X_LI, TreeLink* link);

// The joint's axis, of any length; readers refuse what is shorter than this.
inline constexpr double kShortestAxis = 1e-6;
void SetAxis(const Eigen::Vector3d& axis, TreeJoint* joint);

// The names of the links, for messages.
std::string LinkNames(const std::vector<TreeLink>& links);

}  // namespace armcal
