#include "calib/diagnose/candidates/file_fields.h"

#include "model/dynamics/joint_term.h"
#include "model/robot_files/robot_formats.h"

namespace armcal {
namespace {

std::vector<std::string> FormatsThatHold(RobotField field) {
  std::vector<std::string> names;
  for (const RobotFormat& format : RobotFormats()) {
    if (format.Holds(field)) names.push_back(format.name);
  }
  return names;
}

}  // namespace

bool AddToFile(const CarriedEffect& carried, Joint* joint, JointDrive* drive) {
  if (carried.found.joint < 0) return false;
  const Effect& effect = *carried.found.effect;
  if (effect.joint_term) {
    *TermOf(*effect.joint_term, joint) += carried.found.p[0];
    return true;
  }
  return effect.set_drive && effect.set_drive(carried.numbers, drive);
}

bool IsIn(const RobotFormat& format, const CarriedEffect& effect) {
  Joint joint;
  JointDrive drive;
  if (effect.in_robot) return true;
  if (effect.acts_late) return format.Holds(RobotField::kLaws);
  return AddToFile(effect, &joint, &drive) && format.Holds(joint, drive);
}

std::vector<std::string> FormatsWith(const CarriedEffect& effect) {
  std::vector<std::string> names;
  for (const RobotFormat& format : RobotFormats()) {
    if (IsIn(format, effect)) names.push_back(format.name);
  }
  return names;
}

bool IsMissingInSome(const CarriedEffect& effect) {
  return FormatsWith(effect).size() < RobotFormats().size();
}

std::vector<std::string> FormatsWithOffset() {
  return FormatsThatHold(RobotField::kOffset);
}

std::vector<std::string> FormatsWithDelay(const CorrectedRobot& robot) {
  if (!robot.acts_late()) return {};
  return FormatsThatHold(RobotField::kLaws);
}

}  // namespace armcal
