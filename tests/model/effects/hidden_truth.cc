#include "tests/model/effects/hidden_truth.h"

#include "model/plant/hidden/hidden_effects.h"

namespace armcal {

std::map<std::string, double> HideEffect(const std::string& effect, int joint,
                                         const Robot& robot, double duration,
                                         SimulatedRobot* plant) {
  EffectContext context = TypicalContext(robot, 0);
  context.duration = duration;
  const HiddenEffect& hidden = *FindHiddenEffect(effect);
  std::map<std::string, double> truth;
  for (const EffectValue& value : ApplyHiddenEffect(
           hidden, plant, joint, UsualParameters(hidden), context)) {
    truth[value.name] = value.value;
  }
  return truth;
}

}  // namespace armcal
