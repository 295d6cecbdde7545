#include "model/effects/effects.h"

namespace armcal {

const Effect* FindEffect(const std::string& name) {
  for (const Effect& effect : Effects()) {
    if (effect.name == name) return &effect;
  }
  return nullptr;
}

}  // namespace armcal
