#include "calib/diagnose/candidates/coordinates.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace armcal {
namespace {

using Search = EffectParameter::Search;

// What lasts longer is no touch; s.
constexpr double kShortestEvent = .03, kLongestEvent = 1.2;

Coordinate GridCoordinate(const EffectParameter& parameter,
                          const EffectSite& site, double value) {
  Coordinate c{0, 0, value, 1};
  const std::vector<double> grid = parameter.grid(site);
  c.low = grid.front();
  c.high = grid.back();
  c.by_factors = c.low > 0 && value > 0;
  c.scale = c.by_factors ? .3 : .2 * (c.high - c.low);
  return c;
}

// Whole numbers (a neighbour's index, a harmonic of the joint) are not varied.
bool IsChoice(const EffectParameter& parameter, const EffectSite& site) {
  if (parameter.search != Search::kGrid) return false;
  const std::vector<double> grid = parameter.grid(site);
  return grid.size() < 2 || std::all_of(grid.begin(), grid.end(), [](double x) {
           return x == std::round(x);
         });
}

// A parameter as a solver sees it, nothing where it is not varied, as whole
// numbers are not; `size`: of linear ones. A step of the order of 1 changes the
// torque noticeably: a frequency of position is scaled by what turns the phase
// by a radian over the joint's range, one of time by .3 cycles over the logs'
// time.
std::optional<Coordinate> CoordinateOf(const EffectParameter& parameter,
                                       const EffectSite& site, double value,
                                       double size) {
  const MotionScale& scale = *site.scale;
  Coordinate c{0, 0, value, 1};
  switch (parameter.search) {
    case Search::kLinear:
      c.scale = size;
      break;
    case Search::kGrid:
    case Search::kRefined:
      if (IsChoice(parameter, site)) return {};
      c = GridCoordinate(parameter, site, value);
      break;
    case Search::kPositionFrequency:
      c.scale = 1 / (scale.high[site.joint] - scale.low[site.joint]);
      break;
    case Search::kTimeFrequency:
      c.scale = .3 / (scale.end - scale.begin);
      break;
    case Search::kTime:
      c.scale = .1;
      break;
    case Search::kDuration:
      c.by_factors = true;
      c.scale = .3;
      c.low = kShortestEvent;
      c.high = kLongestEvent;
      break;
  }
  return c;
}

// A linear parameter without a torque in these logs: unevenness where stamps
// are even. A search would leave it anywhere.
bool IsAbsent(const GapCandidate& effect, int linear) {
  if (effect.torque.empty()) return false;  // not evaluated
  const JointRows& torque = effect.torque[linear];
  return std::all_of(torque.begin(), torque.end(),
                     [](const auto& of_joint) { return of_joint.size() == 0; });
}

}  // namespace

// The parameters that a fit may vary, of one effect or of all. Linear
// parameters without any torque in these logs are not: their coefficient would
// be whatever the starting point was, and a covariance of it undefined.
std::vector<Coordinate> ListCoordinates(
    const GapBaseline& baseline, const MotionScale& scale,
    const std::vector<GapCandidate>& effects, int only) {
  std::vector<Coordinate> coordinates;
  for (int e = 0; e < static_cast<int>(effects.size()); ++e) {
    if (only >= 0 && only != e) continue;
    const GapCandidate& effect = effects[e];
    const auto& parameters = effect.effect->parameters;
    int linear = 0;
    for (int k = 0; k < static_cast<int>(parameters.size()); ++k) {
      double size = 0;
      if (parameters[k].search == Search::kLinear) {
        size = effect.size[linear];
        if (IsAbsent(effect, linear++)) continue;
      }
      std::optional<Coordinate> c =
          CoordinateOf(parameters[k], {&baseline.robot(), effect.joint, &scale},
                       effect.p[k], size);
      if (!c) continue;
      if (effect.IsPositive(k)) c->low = 0;
      if (effect.IsAsFirst(k)) (effect.p[0] < 0 ? c->high : c->low) = 0;
      c->effect = e;
      c->parameter = k;
      coordinates.push_back(*c);
    }
  }
  return coordinates;
}

}  // namespace armcal
