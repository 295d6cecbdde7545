#include "model/effects/effect.h"

#include <glog/logging.h>

#include <algorithm>

namespace armcal {
inline namespace effects {

bool IsCarriedBody(const Effect& effect) {
  return std::any_of(effect.parameters.begin(), effect.parameters.end(),
                     [](const EffectParameter& parameter) {
                       return parameter.sign == EffectParameter::Sign::kAsFirst;
                     });
}

bool HasMean(const Effect& law, const Effect& mean) {
  return std::count(law.means.begin(), law.means.end(), mean.name) > 0;
}

std::string ParameterUnit(const std::string& unit, JointType type) {
  std::string text;
  for (const char c : unit) {
    if (c == 'E') {
      text += EffortUnit(type);
    } else if (c == 'P') {
      text += PositionUnit(type);
    } else {
      text += c;
    }
  }
  return text;
}

double NumberOf(const EffectNumbers& numbers, const std::string& name) {
  const auto found =
      std::find_if(numbers.begin(), numbers.end(),
                   [&](const auto& number) { return number.first == name; });
  CHECK(found != numbers.end()) << name;
  return found->second;
}

std::vector<EffectEstimate> EstimatesOf(const Effect& effect,
                                        const EffectSite& site,
                                        const Eigen::VectorXd& p) {
  if (effect.estimates) return effect.estimates(site, p);
  const JointType type = site.joint < 0 ? JointType::kRevolute : site.at().type;
  std::vector<EffectEstimate> estimates;
  for (size_t k = 0; k < effect.parameters.size(); ++k) {
    const EffectParameter& parameter = effect.parameters[k];
    estimates.push_back(
        {parameter.name, ParameterUnit(parameter.unit, type), p[k]});
  }
  return estimates;
}

}  // namespace effects
}  // namespace armcal
