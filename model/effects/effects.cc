#include "model/effects/effects.h"

#include <algorithm>

#include "model/effects/effect_list.h"

namespace armcal {
inline namespace effects {

#define ARMCAL_DECLARE(function) Effect function();
ARMCAL_EFFECTS(ARMCAL_DECLARE)
#undef ARMCAL_DECLARE

namespace {

// The one that is so.
const Effect& The(bool Effect::*is) {
  return *std::find_if(Effects().begin(), Effects().end(),
                       [is](const Effect& effect) { return effect.*is; });
}

}  // namespace

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

const Effect& ContactEffect() { return The(&Effect::is_contact); }

const Effect& ClockEffect() { return The(&Effect::is_clock); }

}  // namespace effects
}  // namespace armcal
