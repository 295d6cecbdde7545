#include "model/robot_tree/robot_tree.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "model/text/input_text.h"

namespace armcal {

std::optional<int> RobotTree::FindLink(const std::string& link_name) const {
  for (size_t i = 0; i < links.size(); ++i) {
    if (links[i].name == link_name) return static_cast<int>(i);
  }
  return std::nullopt;
}

std::vector<int> RobotTree::JointsAbove(int link) const {
  std::vector<int> above;
  for (int j = links[link].parent_joint; j >= 0;
       j = links[joints[j].parent].parent_joint) {
    if (!joints[j].is_fixed) above.push_back(j);
  }
  return above;
}

std::vector<int> RobotTree::JointsBetween(int link, int other) const {
  std::vector<int> a = JointsAbove(link), b = JointsAbove(other), between;
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(),
                                std::back_inserter(between));
  return between;
}

void SetInertial(double mass, const Eigen::Matrix3d& inertia,
                 const Eigen::Isometry3d& X_LI, TreeLink* link) {
  if (mass == 0) {
    link->notes.push_back("link " + Quoted(link->name) +
                          (inertia.isZero(0)
                               ? " has mass 0, read as no inertia given"
                               : " has moments of inertia without a mass; they "
                                 "count where it is fixed to a link with one"));
    if (inertia.isZero(0)) return;
  }
  link->has_inertial = true;
  link->inertial = InertialParameters::FromCenterOfMass(
                       mass, Eigen::Vector3d::Zero(), inertia)
                       .ReexpressIn(X_LI);
  const std::string why = WhyUnphysical(link->inertial);
  if (why.empty() || mass == 0) return;
  link->notes.push_back("the inertia of link " + Quoted(link->name) +
                        " is no rigid body's (" + why +
                        "); it serves as a start value only");
}

void SetAxis(const Eigen::Vector3d& axis, TreeJoint* joint) {
  const double length = axis.stableNorm();
  joint->axis = axis / length;
  if (std::abs(length - 1) <= 1e-3) return;
  joint->notes.push_back("the axis of joint " + Quoted(joint->joint.name) +
                         " has length " + NumberText(length) +
                         ", normalised to 1");
}

std::string LinkNames(const std::vector<TreeLink>& links) {
  std::vector<std::string> names;
  for (const TreeLink& link : links) names.push_back(link.name);
  return JoinNames(names);
}

}  // namespace armcal
