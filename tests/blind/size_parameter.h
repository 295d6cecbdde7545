#pragma once

#include <vector>

#include "model/plant/hidden/hidden_effect.h"

namespace armcal {

// Which parameter of a hidden effect is its size.
struct SizeParameter {
  int index = 0;
  bool falls = false;  // the effect is the stronger, the smaller it is
  // Others that whoever estimates the effect fits as freely: torques of any of
  // their values are sums of those of a few.
  std::vector<int> linear;
};
SizeParameter SizeParameterOf(const HiddenEffect& kind);

}  // namespace armcal
