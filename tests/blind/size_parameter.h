#pragma once

#include "model/plant/hidden/hidden_effect.h"

namespace armcal {

// Which parameter of a hidden effect is its size.
struct SizeParameter {
  int index = 0;
  bool falls = false;  // the effect is the stronger, the smaller it is
};
SizeParameter SizeParameterOf(const HiddenEffect& kind);

}  // namespace armcal
