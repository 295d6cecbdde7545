#pragma once

#include <set>
#include <string>
#include <vector>

#include "model/robot_files/mjcf/mjcf_defaults.h"
#include "model/robot_files/mjcf/mjcf_parts.h"
#include "model/robot_files/mjcf/mjcf_settings.h"

namespace armcal {

// A joint that yields is two in MJCF: the motor's, and behind it, about the
// same axis of the same body, one on a spring or between close limits by which
// the link lags its motor. Together they are one joint of the arm.
class MjcfGears {
 public:
  // Actuators, tendons and equalities refer to none of them.
  explicit MjcfGears(const XmlElement& root);

  // Joints of a body, and those of them that are gears of the one before.
  struct Joints {
    std::vector<const MjcfPart*> driven, gears;
  };
  Joints Split(const std::vector<MjcfPart>& parts, const MjcfDefaults& defaults,
               const MjcfSettings& settings) const;

 private:
  bool IsGear(const MjcfPart& motor, const MjcfPart& gear,
              const MjcfDefaults& defaults, const MjcfSettings& settings) const;

  std::set<std::string> in_use_;  // names of joints
};

}  // namespace armcal
