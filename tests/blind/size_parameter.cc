#include "tests/blind/size_parameter.h"

namespace armcal {

SizeParameter SizeParameterOf(const HiddenEffect& kind) {
  // A limit cuts the more, and a stand sways the more, the lower it is.
  const bool falls =
      kind.name == "torque_saturation" || kind.name == "mount_resonance";
  std::vector<int> linear;
  const bool mass = kind.name == "payload" || kind.name == "added_mass";
  if (mass) linear = {1, 2, 3};                // by its first moment
  if (kind.name == "base_tilt") linear = {1};  // by gravity's direction
  return {0, falls, linear};
}

}  // namespace armcal
