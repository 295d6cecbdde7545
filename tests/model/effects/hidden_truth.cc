#include "tests/model/effects/hidden_truth.h"

#include "model/plant/hidden/hidden_effects.h"

namespace armcal {

std::map<std::string, double> HideEffect(const std::string& effect, int joint,
                                         const Robot& robot, double duration,
                                         SimulatedRobot* plant,
                                         const std::vector<double>& first) {
  EffectContext context = TypicalContext(robot, 0);
  context.duration = duration;
  const HiddenEffect& hidden = *FindHiddenEffect(effect);
  Eigen::VectorXd parameters = UsualParameters(hidden);
  for (size_t k = 0; k < first.size(); ++k) parameters[k] = first[k];
  std::map<std::string, double> truth;
  for (const EffectValue& value :
       ApplyHiddenEffect(hidden, plant, joint, parameters, context)) {
    truth[value.name] = value.value;
  }
  return truth;
}

}  // namespace armcal
