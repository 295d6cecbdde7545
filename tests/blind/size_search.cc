#include "tests/blind/size_search.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "tests/blind/size_parameter.h"

namespace armcal {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Sizes as log strengths: rising with the effect.
class Strength {
 public:
  explicit Strength(const ChosenEffect& effect)
      : effect_(effect),
        parameter_(SizeParameterOf(*effect.kind)),
        sign_(parameter_.falls ? -1 : 1) {
    const double a = sign_ * std::log(Range().least);
    const double b = sign_ * std::log(Range().most);
    low = std::min(a, b);
    high = std::max(a, b);
  }

  double Of(const ChosenEffect& effect) const {
    return sign_ * std::log(std::abs(effect.parameters[parameter_.index]));
  }
  ChosenEffect At(double u) const {
    ChosenEffect effect = effect_;
    double& p = effect.parameters[parameter_.index];
    p = std::copysign(
        std::clamp(std::exp(sign_ * u), Range().least, Range().most), p);
    return effect;
  }
  std::string Text(double u) const {
    char number[40];
    std::snprintf(number, sizeof number, "%.3g",
                  std::abs(At(u).parameters[parameter_.index]));
    return Range().name + " " + number;
  }

  double low, high;

 private:
  const EffectParameter& Range() const {
    return effect_.kind->parameters[parameter_.index];
  }
  ChosenEffect effect_;
  SizeParameter parameter_;
  double sign_;
};

// Between which strengths the wanted one lies.
class Search {
 public:
  Search(const SizeAim& aim, const Strength& range)
      : aim_(aim), range_(range) {}

  // What to try after `u`, which the arm did not follow, or which had an ENR;
  // nothing when no strength is left.
  std::optional<double> AfterFailure(double u) {
    below_ = blocked_ = std::min(blocked_, u);
    return Left(u, std::isfinite(above_) ? (above_ + u) / 2 : u - std::log(3));
  }
  std::optional<double> After(double u, double enr) {
    const double value = std::log(std::max(enr, 1e-6));
    double slope = 1;
    if (std::isfinite(last_u_) && std::abs(u - last_u_) > 1e-3) {
      slope = std::clamp((value - last_value_) / (u - last_u_), .3, 3.);
    }
    if (enr < aim_.low) {
      above_ = std::max(above_, u);
    } else {
      below_ = std::min(below_, u);
    }
    last_u_ = u;
    last_value_ = value;
    return Left(u, u + (std::log(aim_.target) - value) / slope);
  }
  // Why nothing nearer than the size `u` with this ENR was found.
  std::string Limit(double u, double enr) const {
    if (enr >= aim_.high && u < range_.low + .01) {
      return "no less than " + range_.Text(u);
    }
    if (enr < aim_.low && std::isfinite(blocked_)) {
      return "the arm does not follow its motion at " + range_.Text(blocked_);
    }
    if (enr < aim_.low && u > range_.high - .01) {
      return "no more than " + range_.Text(u);
    }
    return "not found near " + range_.Text(u);
  }

 private:
  std::optional<double> Left(double u, double next) const {
    if (next <= above_ || next >= below_) {
      next = (std::max(above_, range_.low) + std::min(below_, range_.high)) / 2;
    }
    next = std::clamp(next, range_.low, range_.high);
    if (std::abs(next - u) < .01) return std::nullopt;
    return next;
  }

  SizeAim aim_;
  const Strength& range_;
  double above_ = -kInfinity;   // the largest that is too small
  double below_ = kInfinity;    // the smallest that is too large
  double blocked_ = kInfinity;  // that the arm does not follow
  double last_u_ = -kInfinity, last_value_ = 0;
};

}  // namespace

std::optional<FoundSize> FindSize(const ChosenEffect& start, const SizeAim& aim,
                                  const MeasureSize& measure) {
  const Strength range(start);
  Search search(aim, range);
  std::optional<FoundSize> best;
  double best_u = 0, best_distance = kInfinity;
  std::optional<double> u = std::clamp(range.Of(start), range.low, range.high);
  for (int k = 0; k < kMostSizes && u; ++k) {
    const ChosenEffect effect = range.At(*u);
    const auto size = measure(effect);
    if (!size) {
      u = search.AfterFailure(*u);
      continue;
    }
    const double distance =
        std::abs(std::log(std::max(size->enr, 1e-6) / aim.target));
    if (distance < best_distance) {
      best = FoundSize{effect, *size, ""};
      best_u = *u;
      best_distance = distance;
    }
    if (size->enr >= aim.low && size->enr < aim.high) {
      return FoundSize{effect, *size, ""};
    }
    u = search.After(*u, size->enr);
  }
  if (best) best->limit = search.Limit(best_u, best->size.enr);
  return best;
}

}  // namespace armcal
