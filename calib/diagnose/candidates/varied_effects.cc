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

std::vector<double> VariedEffects::GridOf(const Coordinate& c) const {
  return ParameterOf(c).grid(
      {&baseline_.robot(), effects_[c.effect].joint, &scale_});
}

// Shapes of the effect that are refined, if all of them stand where they are
// tried first.
std::vector<const Coordinate*> VariedEffects::YetToBeRefined(int effect) const {
  std::vector<const Coordinate*> shapes;
  for (const Coordinate& c : coordinates_) {
    if (c.effect != effect ||
        ParameterOf(c).search != EffectParameter::Search::kRefined) {
      continue;
    }
    const std::vector<double> grid = GridOf(c);
    const double value = effects_[effect].p[c.parameter];
    if (std::count(grid.begin() + 1, grid.end() - 1, value) == 0) return {};
    shapes.push_back(&c);
  }
  return shapes;
}

// The usual size by every combination of the shapes' values, those between
// which a refined one may be included.
void VariedEffects::AddShapes(int effect, std::vector<VectorXd>* points) const {
  const GapCandidate& own = effects_[effect];
  std::vector<VectorXd> all = {points->front()};
  for (const Coordinate& c : coordinates_) {
    if (c.effect != effect) continue;
    const EffectParameter& parameter = ParameterOf(c);
    std::vector<double> values;
    if (parameter.grid) {
      values = GridOf(c);
      values.erase(std::unique(values.begin(), values.end()), values.end());
    } else {
      values = {parameter.size({&baseline_.robot(), own.joint, &scale_})};
    }
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
  for (int e = 0; e < static_cast<int>(effects_.size()); ++e) {
    const std::vector<const Coordinate*> shapes = YetToBeRefined(e);
    if (shapes.empty()) continue;
    const Effect& effect = *effects_[e].effect;
    if (!effect.proportional && effect.larger_sizes.empty()) {
      AddShapes(e, &points);
      continue;
    }
    for (const Coordinate* shape : shapes) {
      for (const Coordinate& size : coordinates_) {
        if (size.effect == e &&
            ParameterOf(size).search == EffectParameter::Search::kLinear) {
          AddAround(size, *shape, &points);
        }
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
