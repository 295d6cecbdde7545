#include "model/robot_files/mjcf/mjcf_pose.h"

#include <cctype>
#include <cmath>
#include <string>

#include "model/robot/axis_rotation.h"

namespace armcal {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kShortest = 1e-10;  // below, a direction is none

Vector3d Direction(const XmlElement& element, const char* attribute,
                   const Vector3d& v) {
  if (v.norm() < kShortest) {
    element.Refuse(attribute, element.Text(attribute),
                   "expected directions that are not zero");
  }
  return v.normalized();
}

Matrix3d ReadQuaternion(const XmlElement& element) {
  double wxyz[4];
  element.Numbers("quat", 4, "", wxyz);
  const Eigen::Quaterniond q(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  if (q.norm() < kShortest) {
    element.Refuse("quat", element.Text("quat"),
                   "expected w x y z that are not all zero");
  }
  return q.normalized().toRotationMatrix();
}

Matrix3d ReadAxisAngle(const XmlElement& element, const MjcfSettings& s) {
  double v[4];
  element.Numbers("axisangle", 4, "", v);
  const Vector3d axis =
      Direction(element, "axisangle", Vector3d(v[0], v[1], v[2]));
  return AngleAxisd(MjcfAngle(v[3], s), axis).toRotationMatrix();
}

// Small letters turn about the axes of the moved frame, capitals about those of
// the parent's.
Matrix3d ReadEuler(const XmlElement& element, const MjcfSettings& settings) {
  const Vector3d angles = element.Vector("euler", "");
  Matrix3d R = Matrix3d::Identity();
  for (int i = 0; i < 3; ++i) {
    const char letter = settings.eulerseq[i];
    const Vector3d axis = Vector3d::Unit(std::tolower(letter) - 'x');
    const Matrix3d turn =
        AngleAxisd(MjcfAngle(angles[i], settings), axis).toRotationMatrix();
    R = std::islower(letter) ? Matrix3d(R * turn) : Matrix3d(turn * R);
  }
  return R;
}

// y without what it has along x.
Matrix3d ReadXyAxes(const XmlElement& element) {
  double v[6];
  element.Numbers("xyaxes", 6, "", v);
  const Vector3d x = Direction(element, "xyaxes", Vector3d(v[0], v[1], v[2]));
  const Vector3d given(v[3], v[4], v[5]);
  const Vector3d y = Direction(element, "xyaxes", given - x * x.dot(given));
  Matrix3d R;
  R << x, y, x.cross(y);
  return R;
}

Matrix3d ReadRotation(const XmlElement& element, const std::string& how,
                      const MjcfSettings& settings) {
  if (how == "quat") return ReadQuaternion(element);
  if (how == "axisangle") return ReadAxisAngle(element, settings);
  if (how == "euler") return ReadEuler(element, settings);
  if (how == "xyaxes") return ReadXyAxes(element);
  return RotationOfZ(Direction(element, "zaxis", element.Vector("zaxis", "")));
}

}  // namespace

double MjcfAngle(double angle, const MjcfSettings& settings) {
  return settings.degrees ? angle * kDegree : angle;
}

Matrix3d RotationOfZ(const Vector3d& direction) {
  const Vector3d axis = Vector3d::UnitZ().cross(direction);
  const double sine = axis.norm();
  return AngleAxisd(
             std::atan2(sine, direction.z()),
             sine < kShortest ? Vector3d::UnitX() : Vector3d(axis / sine))
      .toRotationMatrix();
}

Isometry3d ReadMjcfPose(const MjcfElement& element,
                        const MjcfSettings& settings) {
  Isometry3d X = Isometry3d::Identity();
  X.translation() = element.VectorOr("pos", "m", Vector3d::Zero());
  for (const XmlElement& holder : element.holders()) {
    std::string found;
    for (const char* how : {"quat", "axisangle", "euler", "xyaxes", "zaxis"}) {
      if (!holder.Has(how)) continue;
      if (!found.empty()) {
        holder.Refuse(
            how, holder.Text(how),
            "expected one orientation: there is " + found + " already");
      }
      found = how;
    }
    if (found.empty()) continue;
    X.linear() = ReadRotation(holder, found, settings);
    break;
  }
  return X;
}

}  // namespace armcal
