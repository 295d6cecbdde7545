#pragma once

#include <Eigen/Geometry>
#include <string>
#include <unordered_map>
#include <vector>

#include "model/inertial_parameters.h"
#include "model/joint.h"
#include "model/xml_element.h"

namespace armcal {

// The links and joints of a URDF file as they stand there. They refer to each
// other by index; -1 is none.
struct UrdfLink {
  std::string name;
  int line = 0;
  InertialParameters inertial;  // about Lo, expressed in L
  bool has_inertial = false;
  int parent_joint = -1;
  std::vector<int> child_joints;
  std::vector<std::string> notes;  // for Robot::notes, if the robot has it
};

struct UrdfJoint {
  std::string type;  // as in the file
  int line = 0;
  bool is_fixed = false;
  bool is_supported = false;  // one of JointType
  bool is_mimic = false;
  Joint joint;  // of a fixed or unsupported joint only the name
  int parent = -1;
  int child = -1;
  Eigen::Isometry3d X_PJ = Eigen::Isometry3d::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  // in J, unit length
  std::vector<std::string> notes;
};

using UrdfLinkIndex = std::unordered_map<std::string, int>;

// Read one <link> or <joint>. They throw InputError for whatever the element
// and its children have wrong; `links` are the file's, `index` finds them.
UrdfLink ReadUrdfLink(XmlElement element);
UrdfJoint ReadUrdfJoint(XmlElement element, const std::vector<UrdfLink>& links,
                        const UrdfLinkIndex& index);

// The names of the links, for messages.
std::string LinkNames(const std::vector<UrdfLink>& links);

}  // namespace armcal
