#include "calib/excite/separation_question.h"

#include <cmath>
#include <stdexcept>

#include "calib/linear/identifiability.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr double kWidth = .02;  // rad/s or m/s, of friction

// What joints do when they move with half of their velocities.
MotionScale TypicalScale(const Robot& robot, const ModelParameters& model,
                         const MotionLimits& limits) {
  const ReferenceScale reference = MakeReferenceScale(
      model, limits.velocity.mean() / 2, .5, 1,
      VectorXd::Zero(robot.num_joints()), model.Values(robot));
  MotionScale scale;
  scale.torque = scale.load = reference.torque;
  scale.top_torque = 2 * reference.torque;
  scale.speed = limits.velocity / 2;
  scale.top_speed = limits.velocity;
  scale.acceleration = M_PI * scale.speed;
  scale.low = limits.lower;
  scale.high = limits.upper;
  scale.width = VectorXd::Constant(robot.num_joints(), kWidth);
  scale.end = 20;
  return scale;
}

}  // namespace

SeparationQuestion::SeparationQuestion(const Robot& robot,
                                       const std::vector<const Effect*>& list,
                                       const ModelParameters& model,
                                       const MotionLimits& limits)
    : scale(TypicalScale(robot, model, limits)) {
  using Search = EffectParameter::Search;
  for (const Link& link : robot.links) joint_types.push_back(link.joint.type);
  for (const Effect* effect : list) {
    const bool whole = effect->scope == Effect::Scope::kRobot;
    const size_t before = columns.size();
    std::string why;
    for (int j = whole ? -1 : 0; j < (whole ? 0 : robot.num_joints()); ++j) {
      const EffectSite site{&robot, j, &scale};
      if (effect->unfit && !effect->unfit(site).empty()) {
        why = effect->unfit(site);
        continue;
      }
      VectorXd usual(effect->parameters.size());
      for (size_t k = 0; k < effect->parameters.size(); ++k) {
        const EffectParameter& parameter = effect->parameters[k];
        const bool linear = parameter.search == Search::kLinear;
        usual[static_cast<long>(k)] = linear ? 0 : parameter.size(site);
      }
      for (size_t k = 0; k < effect->parameters.size(); ++k) {
        const EffectParameter& parameter = effect->parameters[k];
        if (parameter.search != Search::kLinear) continue;
        VectorXd p = usual;
        p[static_cast<long>(k)] = parameter.size(site);
        columns.push_back(
            {effect, j, static_cast<int>(k), p, parameter.size(site)});
      }
    }
    if (columns.size() > before) continue;
    throw std::invalid_argument(
        effect->name +
        (why.empty() ? " has no size that torque is linear in" : ": " + why));
  }
}

}  // namespace armcal
