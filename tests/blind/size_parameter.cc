#include "tests/blind/size_parameter.h"

namespace armcal {

SizeParameter SizeParameterOf(const HiddenEffect& kind) {
  // A limit cuts the more, and a stand sways the more, the lower it is.
  const bool falls =
      kind.name == "torque_saturation" || kind.name == "mount_resonance";
  return {0, falls};
}

}  // namespace armcal
