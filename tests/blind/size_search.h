#pragma once

#include <functional>
#include <optional>
#include <string>

#include "tests/blind/blind_case.h"
#include "tests/blind/effect_size.h"

namespace armcal {

// An effect with the size that it was to have, as near as it can.
struct FoundSize {
  ChosenEffect effect;
  EffectSize size;
  std::string limit;  // why it is not near enough; empty where it is
};

// Nothing where the arm does not follow its motion.
using MeasureSize =
    std::function<std::optional<EffectSize>(const ChosenEffect& effect)>;

// Varies the effect's size within its valid range until its ENR is within the
// aim: by secants of log ENR over log size, at most kMostSizes measurements.
// Nothing where the arm follows at none of the sizes tried.
inline constexpr int kMostSizes = 7;
std::optional<FoundSize> FindSize(const ChosenEffect& start, const SizeAim& aim,
                                  const MeasureSize& measure);

}  // namespace armcal
