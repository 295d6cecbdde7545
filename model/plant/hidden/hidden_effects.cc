#include "model/plant/hidden/hidden_effects.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "model/plant/hidden/amplifier_effects.h"
#include "model/plant/hidden/conditional_friction.h"
#include "model/plant/hidden/drive_dynamics.h"
#include "model/plant/hidden/friction_memory.h"
#include "model/plant/hidden/link_wrenches.h"
#include "model/plant/hidden/mount_resonance.h"
#include "model/plant/hidden/position_torques.h"
#include "model/plant/hidden/random_signal.h"
#include "model/plant/hidden/rigid_body_effects.h"
#include "model/plant/hidden/sensor_effects.h"
#include "model/plant/hidden/time_torques.h"
#include "model/plant/hidden/transmission_effects.h"
#include "model/plant/hidden/velocity_friction.h"

namespace armcal {

using Eigen::VectorXd;
using Draw = EffectParameter::Draw;

const std::vector<HiddenEffect>& HiddenEffects() {
  static const std::vector<HiddenEffect> kEffects = [] {
    std::vector<HiddenEffect> effects;
    for (const auto family :
         {VelocityFriction, ConditionalFriction, FrictionMemory,
          TransmissionEffects, PositionTorques, TimeTorques, AmplifierEffects,
          DriveDynamics, SensorEffects, RigidBodyEffects, LinkWrenches,
          MountResonance}) {
      for (HiddenEffect& effect : family()) effects.push_back(effect);
    }
    std::stable_partition(
        effects.begin(), effects.end(),
        [](const HiddenEffect& effect) { return effect.in_catalogue; });
    return effects;
  }();
  return kEffects;
}

const HiddenEffect* FindHiddenEffect(const std::string& name) {
  for (const HiddenEffect& effect : HiddenEffects()) {
    if (effect.name == name) return &effect;
  }
  return nullptr;
}

namespace {

std::string WhyOutOfRange(const EffectParameter& parameter, double value) {
  const double size =
      parameter.draw == Draw::kLogEitherSign ? std::abs(value) : value;
  if (size >= parameter.least && size <= parameter.most) return "";
  std::ostringstream text;
  text << parameter.name << " = " << value << ": expected "
       << (parameter.draw == Draw::kLogEitherSign ? "of either sign " : "")
       << parameter.least << " to " << parameter.most
       << (parameter.unit == "1" ? "" : " " + parameter.unit);
  return text.str();
}

std::string WhyNoJoint(const HiddenEffect& effect, int joint,
                       const EffectContext& context) {
  if (effect.scope == HiddenEffect::Scope::kRobot) {
    return joint == -1 ? "" : "it is of the whole robot, not of a joint";
  }
  if (joint < 0 || joint >= context.torque.size()) {
    return "the robot has no such joint";
  }
  return context.torque[joint] > 0 && context.speed[joint] > 0 &&
                 context.inertia[joint] > 0
             ? ""
             : "the joint carries nothing: no scale for the effect's size";
}

}  // namespace

std::string WhyNotApplicable(const HiddenEffect& effect,
                             const SimulatedRobot& robot, int joint,
                             const VectorXd& parameters,
                             const EffectContext& context) {
  const int n = robot.robot.num_joints() - robot.num_passive;
  CHECK(context.torque.size() == n && context.speed.size() == n &&
        context.inertia.size() == n);
  std::string why = WhyNoJoint(effect, joint, context);
  if (!why.empty()) return why;
  if (parameters.size() != static_cast<int>(effect.parameters.size())) {
    return std::to_string(parameters.size()) + " parameters: expected " +
           std::to_string(effect.parameters.size());
  }
  for (int k = 0; k < parameters.size(); ++k) {
    why = WhyOutOfRange(effect.parameters[k], parameters[k]);
    if (!why.empty()) return why;
  }
  return effect.unfit ? effect.unfit(robot, joint) : "";
}

std::vector<EffectValue> ApplyHiddenEffect(const HiddenEffect& effect,
                                           SimulatedRobot* robot, int joint,
                                           const VectorXd& parameters,
                                           const EffectContext& context) {
  const std::string why =
      WhyNotApplicable(effect, *robot, joint, parameters, context);
  CHECK(why.empty()) << effect.name << ": " << why;
  CHECK(!effect.changes_robot || robot->wrenches.empty())
      << effect.name << " before effects that act on links, please";
  return effect.apply({robot, joint, parameters, &context});
}

VectorXd UsualParameters(const HiddenEffect& effect) {
  VectorXd p(effect.parameters.size());
  for (int k = 0; k < p.size(); ++k) p[k] = effect.parameters[k].usual;
  return p;
}

VectorXd DrawParameters(const HiddenEffect& effect, std::mt19937_64* random) {
  VectorXd p(effect.parameters.size());
  for (int k = 0; k < p.size(); ++k) {
    const EffectParameter& parameter = effect.parameters[k];
    if (parameter.draw == Draw::kUniform) {
      p[k] = DrawUniform(parameter.low, parameter.high, random);
      continue;
    }
    p[k] = DrawLogUniform(parameter.low, parameter.high, random);
    p[k] = std::clamp(p[k], parameter.low, parameter.high);  // exp(log(x)) != x
    if (parameter.draw == Draw::kLogEitherSign && (*random)() >> 63) {
      p[k] = -p[k];
    }
  }
  return p;
}

}  // namespace armcal
