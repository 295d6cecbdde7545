#include "tests/blind/day_changes.h"

#include <algorithm>
#include <optional>

namespace armcal {
namespace {

const BlindAnswer::Effect* Find(const BlindAnswer& answer,
                                const NamedEffect& placed) {
  for (const BlindAnswer::Effect& effect : answer.effects) {
    if (effect.placed == placed) return &effect;
  }
  return nullptr;
}

std::optional<double> Estimate(const BlindAnswer::Effect& effect,
                               const NamedValue& value) {
  for (const NamedValue& estimate : effect.estimates) {
    if (estimate.name == value.name) return estimate.value;
  }
  return std::nullopt;
}

bool Moved(const BlindLabel& label, const BlindAnswer::Effect& claim,
           const BlindAnswer::Effect& before) {
  constexpr double kShare = .5;
  for (const BlindLabel::Effect& truth : label.effects) {
    if (!(truth.placed == claim.placed) || truth.values.empty()) continue;
    const auto now = Estimate(claim, truth.values[0]);
    const auto then = Estimate(before, truth.values[0]);
    return now && then && (*now - *then) / truth.values[0].value >= kShare;
  }
  return false;
}

}  // namespace

BlindAnswer WithoutDayChanges(const BlindLabel& label, BlindAnswer answer,
                              const BlindAnswer& untouched) {
  const auto of_the_day = [&](const BlindAnswer::Effect& claim) {
    const BlindAnswer::Effect* before = Find(untouched, claim.placed);
    return before != nullptr && !Moved(label, claim, *before);
  };
  answer.effects.erase(
      std::remove_if(answer.effects.begin(), answer.effects.end(), of_the_day),
      answer.effects.end());
  return answer;
}

}  // namespace armcal
