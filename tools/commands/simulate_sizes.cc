#include "tools/commands/simulate_sizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "model/text/input_text.h"
#include "tools/command.h"

namespace armcal {

namespace {

constexpr double kTolerance = 1e-6;  // relative, of sizes that are asked for

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

bool Differ(double a, double b) {
  return std::abs(a - b) > 1e-9 * (std::abs(a) + std::abs(b)) + 1e-15;
}

// The parameter that is to give an effect one of its values a size.
class SizeSearch {
 public:
  SizeSearch(const EffectSize& wanted, const SimulatedRobot& plant,
             const EffectContext& context, const ChosenEffect& effect)
      : wanted_(wanted), plant_(&plant), context_(&context), effect_(&effect) {
    const std::vector<EffectValue> values = Apply(effect.parameters);
    if (Find(values)) return;
    throw UsageError("--effects: " + effect.kind->name + " has no " +
                     wanted.name + " in " + wanted.unit + "; it has " +
                     ValueNames(values));
  }

  // Of parameters that are not taken, the one that changes the value and the
  // fewest others; false: there is none.
  bool Choose(const std::vector<bool>& taken) {
    parameter_ = -1;
    for (int k = 0; k < effect_->parameters.size(); ++k) {
      const int changed = taken[k] ? 0 : Changed(k);
      if (changed == 0 || (parameter_ >= 0 && changed >= changed_)) continue;
      parameter_ = k;
      changed_ = changed;
    }
    return parameter_ >= 0;
  }
  int parameter() const { return parameter_; }
  int changed() const { return changed_; }  // values, by that parameter

  // What the parameter has to be while the others are as they are.
  double Solve() const {
    const bool mirrored = effect_->kind->parameters[parameter_].draw ==
                          EffectParameter::Draw::kLogEitherSign;
    std::optional<double> value = Bisect(wanted_.size);
    if (!value && mirrored) {
      value = Bisect(-wanted_.size);
      if (value) *value = -*value;
    }
    if (value) return *value;
    throw UsageError("--effects: found '" + Text() + "', expected " +
                     (mirrored ? "+-" : "") + Range());
  }

  bool Reached() const {
    return std::abs(Value(effect_->parameters) - wanted_.size) <=
           kTolerance * std::abs(wanted_.size) + 1e-9;
  }

  std::string Text() const {
    return wanted_.name + "=" + NumberText(wanted_.size) + wanted_.unit;
  }
  double ValueNow() const { return Value(effect_->parameters); }

 private:
  // Values rise or fall with their parameter.
  std::optional<double> Bisect(double size) const {
    const auto [low, high] = Bounds(parameter_);
    double a = low, b = high;
    const auto value = [this](double x) { return Value(With(parameter_, x)); };
    const double at_a = value(a), at_b = value(b);
    const double slack = 1e-9 * std::abs(size);
    if (size < std::min(at_a, at_b) - slack ||
        size > std::max(at_a, at_b) + slack) {
      return std::nullopt;
    }
    for (int round = 0; round < 100; ++round) {
      const double middle = (a + b) / 2;
      const bool before = (value(middle) < size) == (at_a < at_b);
      (before ? a : b) = middle;
    }
    // A value in whole steps jumps between them.
    return std::abs(value(a) - size) < std::abs(value(b) - size) ? a : b;
  }

  // How many values change over the parameter's range; 0 unless this one does.
  int Changed(int k) const {
    const std::vector<EffectValue> now = Apply(effect_->parameters);
    std::vector<bool> changes(now.size());
    for (const double bound : Bounds(k)) {
      const std::vector<EffectValue> there = Apply(With(k, bound));
      for (size_t i = 0; i < now.size(); ++i) {
        if (Differ(now[i].value, there[i].value)) changes[i] = true;
      }
    }
    if (!changes[Find(now) - now.data()]) return 0;
    return static_cast<int>(std::count(changes.begin(), changes.end(), true));
  }

  std::string Range() const {
    const auto [low, high] = Bounds(parameter_);
    const double a = Value(With(parameter_, low));
    const double b = Value(With(parameter_, high));
    return NumberText(std::min(a, b)) + " to " + NumberText(std::max(a, b)) +
           " " + wanted_.unit;
  }

  std::vector<EffectValue> Apply(const Eigen::VectorXd& parameters) const {
    SimulatedRobot scratch = *plant_;
    return ApplyHiddenEffect(*effect_->kind, &scratch, effect_->joint,
                             parameters, *context_);
  }

  const EffectValue* Find(const std::vector<EffectValue>& values) const {
    for (const EffectValue& value : values) {
      if (value.name == wanted_.name &&
          WithoutBlanks(value.unit) == WithoutBlanks(wanted_.unit)) {
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
    Eigen::VectorXd parameters = effect_->parameters;
    parameters[k] = value;
    return parameters;
  }

  // Of a parameter of either sign, the positive ones.
  std::array<double, 2> Bounds(int k) const {
    const EffectParameter& parameter = effect_->kind->parameters[k];
    return {parameter.least, parameter.most};
  }

  EffectSize wanted_;
  const SimulatedRobot* plant_;
  const EffectContext* context_;
  const ChosenEffect* effect_;
  int parameter_ = -1, changed_ = 0;
};

}  // namespace

void SetEffectSizes(const std::vector<EffectSize>& sizes,
                    std::vector<bool> given, const SimulatedRobot& plant,
                    const EffectContext& context, ChosenEffect* effect) {
  const std::string why = WhyNotApplicable(*effect->kind, plant, effect->joint,
                                           effect->parameters, context);
  if (!why.empty()) {
    throw UsageError("--effects: " + effect->kind->name + ": " + why);
  }
  std::vector<SizeSearch> searches;
  for (const EffectSize& size : sizes) {
    searches.emplace_back(size, plant, context, *effect);
    if (!searches.back().Choose(given)) {
      throw UsageError("--effects: " + searches.back().Text() +
                       ": no parameter of " + effect->kind->name +
                       " that is not given otherwise changes it");
    }
    given[searches.back().parameter()] = true;
  }
  // What changes many values first: those that change one can then correct it.
  std::stable_sort(searches.begin(), searches.end(),
                   [](const SizeSearch& a, const SizeSearch& b) {
                     return a.changed() > b.changed();
                   });
  for (const SizeSearch& search : searches) {
    effect->parameters[search.parameter()] = search.Solve();
  }
  for (const SizeSearch& search : searches) {
    if (search.Reached()) continue;
    throw UsageError("--effects: found '" + search.Text() +
                     "', with the rest " + "of " + effect->kind->name +
                     " it can only be " + NumberText(search.ValueNow()));
  }
}

}  // namespace armcal
