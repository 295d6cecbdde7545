#include "tools/commands/simulate_effects.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "model/text/input_text.h"
#include "tools/command.h"
#include "tools/commands/simulate_sizes.h"
#include "tools/flag_choices.h"
#include "tools/nearest_name.h"
#include "tools/usage.h"

namespace armcal {

namespace {

[[noreturn]] void Refuse(const std::string& found,
                         const std::string& expected) {
  throw UsageError("--effects: found '" + found + "', expected " + expected);
}

std::vector<std::string> Split(const std::string& text, char at) {
  std::vector<std::string> parts;
  size_t begin = 0;
  while (begin <= text.size()) {
    const size_t end = std::min(text.find(at, begin), text.size());
    parts.emplace_back(Trim(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return parts;
}

FlagWords KindNames() {
  FlagWords names;
  for (const HiddenEffect& effect : HiddenEffects()) {
    names.words.push_back(effect.name);
  }
  return names;
}
const FlagWordsAdded kKinds("effects", &KindNames);

const HiddenEffect& FindKind(const std::string& name) {
  const HiddenEffect* kind = FindHiddenEffect(name);
  if (kind) return *kind;
  const std::string nearest = NearestName(name, KindNames().words);
  Refuse(name, nearest.empty() ? "an effect; --list_effects shows them"
                               : "an effect, such as " + nearest);
}

int FindJoint(const std::string& text, const Robot& robot) {
  const std::vector<std::string> names = robot.JointNames();
  const auto named = std::find(names.begin(), names.end(), text);
  if (named != names.end()) return static_cast<int>(named - names.begin());
  const std::optional<double> number = ParseNumber(text);
  if (number && *number >= 1 && *number <= robot.num_joints() &&
      *number == std::floor(*number)) {
    return static_cast<int>(*number) - 1;
  }
  Refuse(text, "a joint, 1 to " + std::to_string(robot.num_joints()) +
                   " or one of " + JoinNames(names));
}

void SetParameter(const std::string& name, const std::string& number,
                  ChosenEffect* effect, std::vector<bool>* given) {
  const auto& parameters = effect->kind->parameters;
  std::vector<std::string> names;
  for (size_t k = 0; k < parameters.size(); ++k) {
    names.push_back(parameters[k].name);
    if (parameters[k].name != name) continue;
    const std::optional<double> value = ParseNumber(number);
    if (!value || !std::isfinite(*value)) {
      Refuse(name + "=" + number, name + "=NUMBER");
    }
    if ((*given)[k]) Refuse(name + "=" + number, "each parameter once");
    effect->parameters[k] = *value;
    (*given)[k] = true;
    return;
  }
  Refuse(name, "a parameter of " + effect->kind->name + ": " +
                   JoinNames(names) + "; or one of its values with a unit");
}

// "mass=0.03", a parameter, or "mass=2kg", a value in SI units.
void SetParts(const std::vector<std::string>& parts, const Scenario& scenario,
              ChosenEffect* effect) {
  std::vector<bool> given(effect->parameters.size());
  std::vector<EffectSize> sizes;
  for (const std::string& text : parts) {
    const size_t equals = std::min(text.find('='), text.size());
    const std::string name = text.substr(0, equals);
    const std::string size = text.substr(std::min(equals + 1, text.size()));
    const size_t unit =
        std::min(size.find_first_not_of("0123456789.+-eE"), size.size());
    const std::optional<double> value = ParseNumber(size.substr(0, unit));
    const std::string unit_text(Trim(std::string_view(size).substr(unit)));
    if (unit_text.empty() || !value) {
      SetParameter(name, size, effect, &given);
    } else {
      sizes.push_back({name, *value, unit_text});
    }
  }
  if (sizes.empty()) return;
  SetEffectSizes(sizes, given, TrueRobot(scenario), ContextOf(scenario),
                 effect);
}

ChosenEffect ParseEffect(const std::string& text, const Scenario& scenario) {
  const size_t colon = std::min(text.find(':'), text.size());
  const std::vector<std::string> place = Split(text.substr(0, colon), '@');
  ChosenEffect effect;
  effect.kind = &FindKind(place[0]);
  effect.parameters = UsualParameters(*effect.kind);
  const bool of_joint = effect.kind->scope == HiddenEffect::Scope::kJoint;
  if (place.size() != (of_joint ? 2 : 1)) {
    Refuse(text.substr(0, colon),
           of_joint ? place[0] + "@JOINT, an effect of one joint"
                    : place[0] + " without a joint, it is of the whole robot");
  }
  if (of_joint) effect.joint = FindJoint(place[1], scenario.model);
  if (colon == text.size()) return effect;
  SetParts(Split(text.substr(colon + 1), ','), scenario, &effect);
  return effect;
}

std::string Line(const HiddenEffect& effect) {
  std::string text = "  " + effect.name;
  if (effect.scope == HiddenEffect::Scope::kJoint) text += "@JOINT";
  text += "\n      " + Wrapped(effect.sentence, 6);
  for (const EffectParameter& parameter : effect.parameters) {
    const bool either = parameter.draw == EffectParameter::Draw::kLogEitherSign;
    text += "      " + parameter.name + "=" + NumberText(parameter.usual) +
            "  " + (either ? "+-" : "") + NumberText(parameter.least) + " to " +
            NumberText(parameter.most) +
            (parameter.unit == "1" ? "" : " " + parameter.unit) + "\n";
  }
  return text;
}

}  // namespace

std::vector<ChosenEffect> ParseEffects(const std::string& text,
                                       const Scenario& scenario) {
  std::vector<ChosenEffect> effects;
  if (Trim(text).empty()) return effects;
  for (const std::string& part : Split(text, ';')) {
    effects.push_back(ParseEffect(part, scenario));
  }
  return effects;
}

std::string EffectList() {
  std::string known, unknown;
  for (const HiddenEffect& effect : HiddenEffects()) {
    (effect.in_catalogue ? known : unknown) += Line(effect);
  }
  return Wrapped(
             "Effects that armcal diagnose has a name for, with usual values "
             "and ranges. Numbers without a unit are shares of the joint's "
             "usual torque, speed or inertia, or of a radian. The report and "
             "truth.json have values in SI units, and these may be given "
             "instead, with their unit: payload:mass=2kg.",
             0) +
         "\n" + known + "\nEffects that it has none for:\n\n" + unknown;
}

std::string EffectListJson() {
  nlohmann::json effects = nlohmann::json::array();
  for (const HiddenEffect& effect : HiddenEffects()) {
    nlohmann::json parameters = nlohmann::json::array();
    for (const EffectParameter& parameter : effect.parameters) {
      parameters.push_back({{"name", parameter.name},
                            {"unit", parameter.unit},
                            {"usual", parameter.usual},
                            {"least", parameter.least},
                            {"most", parameter.most}});
    }
    effects.push_back(
        {{"effect", effect.name},
         {"of_joint", effect.scope == HiddenEffect::Scope::kJoint},
         {"in_catalogue", effect.in_catalogue},
         {"description", effect.sentence},
         {"parameters", parameters}});
  }
  return effects.dump(2) + "\n";
}

}  // namespace armcal
