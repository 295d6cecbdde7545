#pragma once

#include <string>
#include <vector>

#include "model/effects/effect.h"

namespace armcal {
inline namespace effects {

// Every effect that a diagnosis has a name for, in the order of effect_list.h.
// To add one, write its file and its line there.
const std::vector<Effect>& Effects();
// nullptr where there is none of that name.
const Effect* FindEffect(const std::string& name);
// What contacts are reported as.
const Effect& ContactEffect();
// What a clock of another rate is reported as.
const Effect& ClockEffect();

}  // namespace effects
}  // namespace armcal
