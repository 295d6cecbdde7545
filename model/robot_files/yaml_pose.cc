#include "model/robot_files/yaml_pose.h"

#include "model/robot/robot.h"

namespace armcal {
namespace {

using Eigen::Matrix3d;

Matrix3d ReadRotation(const YamlNode& node) {
  const Eigen::VectorXd rows = node.Vector("1");
  if (rows.size() != 9) node.Refuse("expected a list of nine numbers, by rows");
  const Matrix3d R =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
          rows.data());
  const double skew = (R * R.transpose() - Matrix3d::Identity()).norm();
  if (skew > 1e-6 || R.determinant() < 0) {
    node.Refuse(
        "expected a rotation: orthogonal rows of length 1, right-handed");
  }
  return R;
}

}  // namespace

Eigen::Isometry3d ReadYamlPose(const YamlNode& node) {
  node.ExpectKeys({"xyz", "rpy", "rotation"});
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  const auto xyz = node.Child("xyz"), rpy = node.Child("rpy"),
             rotation = node.Child("rotation");
  if (xyz) X.translation() = xyz->Vector3("m");
  if (rpy && rotation) {
    rotation->Refuse("expected either rpy or rotation, not both");
  }
  if (rpy) X.linear() = RotationFromRpy(rpy->Vector3("rad"));
  if (rotation) X.linear() = ReadRotation(*rotation);
  return X;
}

}  // namespace armcal
