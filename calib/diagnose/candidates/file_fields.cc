#include "calib/diagnose/candidates/file_fields.h"

#include "model/dynamics/joint_term.h"
#include "model/robot_files/robot_formats.h"

namespace armcal {

bool AddToFile(const GapCandidate& found, Joint* joint, JointDrive* drive) {
  if (found.joint < 0) return false;
  const Effect& effect = *found.effect;
  if (effect.joint_term) {
    *TermOf(*effect.joint_term, joint) += found.p[0];
    return true;
  }
  return effect.set_drive && effect.set_drive(found.p, drive);
}

bool IsIn(const RobotFormat& format, const CarriedEffect& effect) {
  Joint joint;
  JointDrive drive;
  return effect.in_robot || (AddToFile(effect.found, &joint, &drive) &&
                             format.Holds(joint, drive));
}

std::vector<std::string> FormatsWith(const CarriedEffect& effect) {
  std::vector<std::string> names;
  for (const RobotFormat& format : RobotFormats()) {
    if (IsIn(format, effect)) names.push_back(format.name);
  }
  return names;
}

std::vector<std::string> FormatsWithOffset() {
  std::vector<std::string> names;
  for (const RobotFormat& format : RobotFormats()) {
    if (format.Holds(RobotField::kOffset)) names.push_back(format.name);
  }
  return names;
}

}  // namespace armcal
