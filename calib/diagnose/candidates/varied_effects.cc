#include "calib/diagnose/candidates/varied_effects.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "calib/diagnose/candidates/effect_torques.h"

namespace armcal {

using Eigen::VectorXd;

VariedEffects::VariedEffects(const GapBaseline& baseline,
                             const MotionScale& scale,
                             std::vector<GapCandidate> effects, int only,
                             const GapData& data)
    : baseline_(baseline),
      scale_(scale),
      effects_(std::move(effects)),
      coordinates_(ListCoordinates(baseline, scale, effects_, only)),
      data_(data),
      torques_([&data] { return data.torques(); }) {}

std::vector<GapCandidate> VariedEffects::At(const VectorXd& u) const {
  std::vector<GapCandidate> effects = effects_;
  for (size_t k = 0; k < coordinates_.size(); ++k) {
    const Coordinate& c = coordinates_[k];
    effects[c.effect].p[c.parameter] = c.Value(u[k]);
  }
  return effects;
}

const EffectParameter& VariedEffects::ParameterOf(const Coordinate& c) const {
  return effects_[c.effect].effect->parameters[c.parameter];
}

// From half of a size to twice of it, for values of a shape.
void VariedEffects::AddAround(const Coordinate& size, const Coordinate& shape,
                              std::vector<VectorXd>* points) const {
  constexpr int kSteps = 12;  // to either side
  const VectorXd u = points->front();
  for (const double share : {0., .01, .03, .1, .3}) {
    for (int k = -kSteps; k <= kSteps; ++k) {
      VectorXd at = u;
      at[&size - coordinates_.data()] = size.Inverse(
          size.centre * std::pow(2, k / static_cast<double>(kSteps)));
      at[&shape - coordinates_.data()] =
          shape.Inverse(shape.low + share * (shape.high - shape.low));
      points->push_back(at);
    }
  }
}

// Whether the shape is one that is refined and stands where it is tried first.
bool VariedEffects::IsYetToBeRefined(const Coordinate& shape) const {
  const EffectParameter& parameter = ParameterOf(shape);
  if (parameter.search != EffectParameter::Search::kRefined) return false;
  const GapCandidate& effect = effects_[shape.effect];
  const std::vector<double> grid =
      parameter.grid({&baseline_.robot(), effect.joint, &scale_});
  return std::count(grid.begin() + 1, grid.end() - 1,
                    effect.p[shape.parameter]) > 0;
}

// All that an effect of one size is tried at: its usual size, by every
// combination of its shapes.
void VariedEffects::AddShapes(int effect, std::vector<VectorXd>* points) const {
  const GapCandidate& own = effects_[effect];
  const EffectSite site = {&baseline_.robot(), own.joint, &scale_};
  std::vector<VectorXd> all = {points->front()};
  for (const Coordinate& c : coordinates_) {
    if (c.effect != effect) continue;
    const EffectParameter& parameter = ParameterOf(c);
    const std::vector<double> values = parameter.grid
                                           ? parameter.grid(site)
                                           : std::vector{parameter.size(site)};
    std::vector<VectorXd> more;
    for (const VectorXd& point : all) {
      for (const double value : values) {
        more.push_back(point);
        more.back()[&c - coordinates_.data()] = c.Inverse(value);
      }
    }
    all = std::move(more);
  }
  points->insert(points->end(), all.begin(), all.end());
}

std::vector<VectorXd> VariedEffects::Starts() const {
  std::vector<VectorXd> points = {VectorXd::Ones(size())};
  for (const Coordinate& shape : coordinates_) {
    if (!IsYetToBeRefined(shape)) continue;
    const Effect& effect = *effects_[shape.effect].effect;
    if (!effect.proportional && effect.larger_sizes.empty()) {
      AddShapes(shape.effect, &points);
      continue;
    }
    for (const Coordinate& size : coordinates_) {
      if (size.effect == shape.effect &&
          ParameterOf(size).search == EffectParameter::Search::kLinear) {
        AddAround(size, shape, &points);
      }
    }
  }
  return points;
}

std::vector<JointRows> VariedEffects::Torques(
    const std::vector<VectorXd>& points) const {
  std::vector<JointRows> torques(points.size());
  tbb::parallel_for(
      tbb::blocked_range<size_t>(0, points.size(), kLanes),
      [&](const tbb::blocked_range<size_t>& range) {
        std::vector<std::vector<GapCandidate>> sets;
        for (size_t k = range.begin(); k < range.end(); ++k) {
          sets.push_back(At(points[k]));
        }
        std::vector<JointRows> some = EffectTorques(
            baseline_, scale_, sets, data_.rows(), &torques_.local());
        for (size_t k = range.begin(); k < range.end(); ++k) {
          torques[k] = std::move(some[k - range.begin()]);
        }
      },
      tbb::simple_partitioner());
  return torques;
}

}  // namespace armcal
