#include "model/robot_files/robot_format.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::Vector3d;

// For people to read: every joint is named, as each value would be missed.
// Nothing where no joint has the value.
std::string JointValues(
    const RobotDescription& description,
    const std::function<double(const Joint&, const JointDrive&)>& value) {
  std::string values;
  for (int j = 0; j < description.robot.num_joints(); ++j) {
    const Joint& joint = description.robot.links[j].joint;
    const double x = value(joint, description.DriveOf(j));
    if (x == 0) continue;
    values += (values.empty() ? "" : ", ") + joint.name + Format(" %.4g", x);
  }
  return values;
}

// What the joint would have in the field; 0: it needs none.
double ValueOf(RobotField field, const Joint& joint, const JointDrive& drive) {
  switch (field) {
    case RobotField::kArmature:
      return joint.armature;
    case RobotField::kOffset:
      return joint.offset;
    case RobotField::kSpring:
      return drive.stiffness;
    case RobotField::kGain:
      return drive.gain == 1 ? 0 : drive.gain;
    case RobotField::kTorqueLimit:
      return std::isfinite(drive.torque_limit) ? drive.torque_limit : 0;
    case RobotField::kTorqueLimitSlope:
      return drive.torque_limit_slope;
    case RobotField::kLaws:
      return drive.HasLaws() ? 1 : 0;
    case RobotField::kVelocityLimit:
      return std::isfinite(joint.velocity) ? joint.velocity : 0;
    case RobotField::kGravity:
    case RobotField::kController:
      break;
  }
  return 0;
}

std::string ValuesOf(RobotField field, const RobotDescription& description) {
  return JointValues(description,
                     [field](const Joint& joint, const JointDrive& drive) {
                       return ValueOf(field, joint, drive);
                     });
}

std::string NameOf(RobotField field) {
  switch (field) {
    case RobotField::kArmature:
      return "armature";
    case RobotField::kOffset:
      return "constant torque";
    case RobotField::kSpring:
      return "springs";
    case RobotField::kGain:
      return "torque given per torque asked";
    case RobotField::kTorqueLimit:
      return "limits of the motors' torque at rest";
    case RobotField::kTorqueLimitSlope:
      return "limits of torque that fall with speed";
    case RobotField::kLaws:
      return "laws of drives";
    case RobotField::kVelocityLimit:
      return "velocity limits";
    case RobotField::kController:
      return "controllers";
    case RobotField::kGravity:
      break;
  }
  return "gravity";
}

std::string GravityLoss(const RobotFormat& format, const Vector3d& g) {
  if ((g - Vector3d(0, 0, -g.norm())).norm() <= 1e-9) return "";
  return Format(
      "%s has no field for gravity, which here is %.10g %.10g %.10g m/s^2, not "
      "along -z",
      format.title, g.x() + 0., g.y() + 0., g.z() + 0.);
}

}  // namespace

bool RobotFormat::Holds(RobotField field) const {
  return std::find(lacks.begin(), lacks.end(), field) == lacks.end();
}

bool RobotFormat::Holds(const Joint& joint, const JointDrive& drive) const {
  return std::all_of(lacks.begin(), lacks.end(), [&](RobotField field) {
    return ValueOf(field, joint, drive) == 0;
  });
}

// XML has its declaration before any comment, and no two dashes within one.
std::string WithComment(const RobotFormat& format, std::string text,
                        const std::vector<std::string>& sentences) {
  const std::string begin =
      format.hash_comments ? "# armcal: " : "<!-- armcal: ";
  const std::string end = format.hash_comments ? "\n" : " -->\n";
  const size_t old = text.find(begin);
  if (old != std::string::npos) {
    text.erase(old, text.find(end, old) + end.size() - old);
  }
  if (sentences.empty()) return text;
  std::string comment;
  for (const std::string& sentence : sentences) {
    comment += (comment.empty() ? "" : "; ") + sentence;
  }
  for (size_t at; (at = comment.find("--")) != std::string::npos;) {
    comment.insert(at + 1, " ");
  }
  const bool declared = text.rfind("<?xml", 0) == 0;
  return text.insert(declared ? text.find('\n') + 1 : 0, begin + comment + end);
}

std::vector<std::string> Losses(const RobotFormat& format,
                                const RobotDescription& description) {
  std::vector<std::string> losses;
  for (const RobotField field : format.lacks) {
    if (field == RobotField::kGravity) {
      const std::string loss = GravityLoss(format, description.robot.gravity);
      if (!loss.empty()) losses.push_back(loss);
      continue;
    }
    if (field == RobotField::kController && description.controller) {
      losses.push_back(std::string(format.title) + " has no field for " +
                       NameOf(field));
      continue;
    }
    const std::string values = ValuesOf(field, description);
    if (values.empty()) continue;
    losses.push_back(std::string(format.title) + " has no field for " +
                     NameOf(field) + " (" + values + ")");
  }
  if (format.more_losses != nullptr) {
    for (const std::string& loss : format.more_losses(description)) {
      losses.push_back(loss);
    }
  }
  return losses;
}

}  // namespace armcal
