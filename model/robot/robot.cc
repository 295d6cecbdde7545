#include "model/robot/robot.h"

#include <algorithm>

namespace armcal {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

Isometry3d Link::X_PL(double q) const {
  return X_PF * JointTransform(joint.type, q) * X_ML;
}

void DeclareMassless(Link* link) {
  link->inertial = InertialParameters();
  link->has_inertial = false;
  link->zero_inertials.clear();
  for (int k = 0; k < 10; ++k) {
    link->zero_inertials.emplace_back(InertialName(k));
  }
}

bool IsDeclaredMassless(const Link& link) {
  return std::count(link.zero_inertials.begin(), link.zero_inertials.end(),
                    InertialName(0)) > 0;
}

std::vector<std::string> Robot::JointNames() const {
  std::vector<std::string> names;
  for (const Link& link : links) names.push_back(link.joint.name);
  return names;
}

Eigen::Matrix3d RotationFromRpy(const Vector3d& rpy) {
  return (AngleAxisd(rpy[2], Vector3d::UnitZ()) *
          AngleAxisd(rpy[1], Vector3d::UnitY()) *
          AngleAxisd(rpy[0], Vector3d::UnitX()))
      .toRotationMatrix();
}

// q about or along z commutes with theta and d, so X_FM(q) may stand first.
void SetDhPose(const DhParameters& dh, DhConvention convention, Link* link) {
  const Isometry3d along_x =
      Translation3d(dh.a, 0, 0) *
      Isometry3d(AngleAxisd(dh.alpha, Vector3d::UnitX()));
  const Isometry3d along_z =
      Translation3d(0, 0, dh.d) *
      Isometry3d(AngleAxisd(dh.theta, Vector3d::UnitZ()));
  if (convention == DhConvention::kStandard) {
    link->X_PF = Isometry3d::Identity();
    link->X_ML = along_z * along_x;
  } else {
    link->X_PF = along_x;
    link->X_ML = along_z;
  }
}

}  // namespace armcal
