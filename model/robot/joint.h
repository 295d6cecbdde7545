#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <string>

namespace armcal {

// The joint types of a serial arm. To add one, extend this enumeration and the
// functions below; readers and dynamics go through them.
enum class JointType { kRevolute, kContinuous, kPrismatic };

// A joint moves its frame M relative to the fixed frame F along their common z
// axis: by the angle q (rad) about z, or by the distance q (m) along z.
struct Joint {
  std::string name;
  JointType type = JointType::kRevolute;
  double lower = -std::numeric_limits<double>::infinity();    // rad or m
  double upper = std::numeric_limits<double>::infinity();     // rad or m
  double velocity = std::numeric_limits<double>::infinity();  // rad/s or m/s
  double effort = std::numeric_limits<double>::infinity();    // N m or N
  double viscous = 0;   // N m s/rad or N s/m, as the robot file gives it
  double coulomb = 0;   // N m or N
  double armature = 0;  // kg m^2 or kg
  double offset = 0;    // N m or N, a constant torque; in no robot file
};

inline bool IsRotational(JointType type) {
  return type != JointType::kPrismatic;
}

inline const char* JointTypeName(JointType type) {
  switch (type) {
    case JointType::kRevolute:
      return "revolute";
    case JointType::kContinuous:
      return "continuous";
    case JointType::kPrismatic:
      return "prismatic";
  }
  return "";
}

// "rad" or "m", the unit of q; and "N m" or "N", the unit of tau.
inline const char* PositionUnit(JointType type) {
  return IsRotational(type) ? "rad" : "m";
}
inline const char* EffortUnit(JointType type) {
  return IsRotational(type) ? "N m" : "N";
}

// X_FM(q), the pose of the moved frame M in the fixed frame F.
Eigen::Isometry3d JointTransform(JointType type, double q);

}  // namespace armcal
