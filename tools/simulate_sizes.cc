#include "tools/simulate_sizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "model/input_text.h"
#include "tools/command.h"

namespace armcal {

namespace {

std::string WithoutBlanks(std::string text) {
  text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
  return text;
}

std::string ValueNames(const std::vector<EffectValue>& values) {
  std::vector<std::string> names;
  for (const EffectValue& value : values) {
    if (value.unit != "1") names.push_back(value.name + " " + value.unit);
  }
  return JoinNames(names);
}

class SizeSearch {
 public:
  SizeSearch(const std::string& name, const std::string& unit,
             const SimulatedRobot& plant, const EffectContext& context,
             const ChosenEffect& effect)
      : name_(name),
        unit_(WithoutBlanks(unit)),
        plant_(plant),
        context_(context),
        effect_(effect) {
    const std::vector<EffectValue> values = Apply(effect.parameters);
    if (Find(values)) return;
    throw UsageError("--effects: " + effect.kind->name + " has no " + name +
                     " in " + unit + "; it has " + ValueNames(values));
  }

  // The parameter that decides the value, -1: none.
  int Deciding() const {
    const double usual = Value(effect_.parameters);
    for (int k = 0; k < effect_.parameters.size(); ++k) {
      for (const double bound : Bounds(k)) {
        if (Value(With(k, bound)) != usual) return k;
      }
    }
    return -1;
  }

  // By bisection: values rise or fall with their parameter.
  std::optional<double> Solve(int k, double size) const {
    const auto [low, high] = Bounds(k);
    double a = low, b = high;
    const double at_a = Value(With(k, a)), at_b = Value(With(k, b));
    const double slack = 1e-9 * std::abs(size);
    if (size < std::min(at_a, at_b) - slack ||
        size > std::max(at_a, at_b) + slack) {
      return std::nullopt;
    }
    for (int round = 0; round < 100; ++round) {
      const double middle = (a + b) / 2;
      const bool before = (Value(With(k, middle)) < size) == (at_a < at_b);
      (before ? a : b) = middle;
    }
    return (a + b) / 2;
  }

  std::string Range(int k) const {
    const auto [low, high] = Bounds(k);
    const double a = Value(With(k, low)), b = Value(With(k, high));
    return NumberText(std::min(a, b)) + " to " + NumberText(std::max(a, b)) +
           " " + unit_;
  }

 private:
  std::vector<EffectValue> Apply(const Eigen::VectorXd& parameters) const {
    SimulatedRobot scratch = plant_;
    return ApplyHiddenEffect(*effect_.kind, &scratch, effect_.joint, parameters,
                             context_);
  }

  const EffectValue* Find(const std::vector<EffectValue>& values) const {
    for (const EffectValue& value : values) {
      if (value.name == name_ && WithoutBlanks(value.unit) == unit_) {
        return &value;
      }
    }
    return nullptr;
  }

  double Value(const Eigen::VectorXd& parameters) const {
    const std::vector<EffectValue> values = Apply(parameters);
    return Find(values)->value;
  }

  Eigen::VectorXd With(int k, double value) const {
    Eigen::VectorXd parameters = effect_.parameters;
    parameters[k] = value;
    return parameters;
  }

  // Of a parameter of either sign, the positive ones.
  std::array<double, 2> Bounds(int k) const {
    const EffectParameter& parameter = effect_.kind->parameters[k];
    return {parameter.low, parameter.high};
  }

  std::string name_, unit_;
  const SimulatedRobot& plant_;
  const EffectContext& context_;
  const ChosenEffect& effect_;
};

}  // namespace

void SetEffectSize(const std::string& name, double size,
                   const std::string& unit, const SimulatedRobot& plant,
                   const EffectContext& context, ChosenEffect* effect) {
  const std::string why = WhyNotApplicable(*effect->kind, plant, effect->joint,
                                           effect->parameters, context);
  if (!why.empty()) {
    throw UsageError("--effects: " + effect->kind->name + ": " + why);
  }
  const SizeSearch search(name, unit, plant, context, *effect);
  const int k = search.Deciding();
  if (k < 0) {
    throw UsageError("--effects: no parameter of " + effect->kind->name +
                     " changes its " + name);
  }
  const bool mirrored =
      effect->kind->parameters[k].draw == EffectParameter::Draw::kLogEitherSign;
  std::optional<double> value = search.Solve(k, size);
  if (!value && mirrored) {
    value = search.Solve(k, -size);
    if (value) *value = -*value;
  }
  if (!value) {
    throw UsageError("--effects: found '" + name + "=" + NumberText(size) +
                     unit + "', expected " + (mirrored ? "+-" : "") +
                     search.Range(k));
  }
  effect->parameters[k] = *value;
}

}  // namespace armcal
