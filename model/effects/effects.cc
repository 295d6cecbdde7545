#include "model/effects/effects.h"

#include <algorithm>

#include "model/effects/effect_list.h"

namespace armcal {
inline namespace effects {

#define ARMCAL_DECLARE(function) Effect function();
ARMCAL_EFFECTS(ARMCAL_DECLARE)
#undef ARMCAL_DECLARE

const std::vector<Effect>& Effects() {
#define ARMCAL_CALL(function) function(),
  static const std::vector<Effect>* const kEffects =
      new std::vector<Effect>{ARMCAL_EFFECTS(ARMCAL_CALL)};
#undef ARMCAL_CALL
  return *kEffects;
}

const Effect* FindEffect(const std::string& name) {
  for (const Effect& effect : Effects()) {
    if (effect.name == name) return &effect;
  }
  return nullptr;
}

const Effect& ContactEffect() {
  return *std::find_if(Effects().begin(), Effects().end(),
                       [](const Effect& effect) { return effect.is_contact; });
}

const Effect& ClockEffect() {
  return *std::find_if(Effects().begin(), Effects().end(),
                       [](const Effect& effect) { return effect.is_clock; });
}

}  // namespace effects
}  // namespace armcal
