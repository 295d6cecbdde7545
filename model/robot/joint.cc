#include "model/robot/joint.h"

namespace armcal {

Eigen::Isometry3d JointTransform(JointType type, double q) {
  Eigen::Isometry3d X_FM = Eigen::Isometry3d::Identity();
  if (IsRotational(type)) {
    X_FM.linear() =
        Eigen::AngleAxisd(q, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  } else {
    X_FM.translation().z() = q;
  }
  return X_FM;
}

}  // namespace armcal
