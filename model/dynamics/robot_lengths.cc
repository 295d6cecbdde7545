#include "model/dynamics/robot_lengths.h"

#include <glog/logging.h>

#include <cmath>

namespace armcal {
namespace {

// Whether the length stands in the link's own row, behind its joint.
bool MovesLinkFrame(const Robot& robot, const Length& length) {
  if (!robot.dh_convention) return false;
  return *robot.dh_convention == DhConvention::kStandard ||
         length.component == 2;
}

}  // namespace

// Moves frames along the direction in which each length lies, by the
// difference. In a file with a DH table the row says which of two frames moves.
Robot WithLengths(const Robot& robot, const std::vector<Length>& lengths) {
  const ProximalChain chain = MakeProximalChain(robot);
  Robot result = robot;
  for (const Length& length : lengths) {
    CHECK(length.joint >= 0 && length.next < robot.num_joints());
    CHECK(length.component == 0 || length.component == 2);
    CHECK(std::isfinite(length.value)) << length.owner_name;
    const ProximalJoint& joint = chain.joints[length.joint];
    // Orientations are those of `robot`, whatever moved before.
    const double value =
        chain.joints[length.next].X_JG.translation()[length.component];
    const Eigen::Vector3d p_J =
        (length.value - value) * Eigen::Vector3d::Unit(length.component);
    const Eigen::Vector3d p_L = joint.X_JL.linear().transpose() * p_J;
    Link& link = result.links[length.joint];
    if (MovesLinkFrame(robot, length)) {
      link.X_ML.translate(p_L);
    } else {
      result.links[length.next].X_PF.pretranslate(p_L);
    }
  }
  return result;
}

}  // namespace armcal
