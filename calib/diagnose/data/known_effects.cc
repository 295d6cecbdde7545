#include "calib/diagnose/data/known_effects.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Only the linear parameters of a known effect stay free, each with the prior
// of its own value or of the size of its effect that matters, whichever is
// more; shapes are held at what the reference showed.
KnownEffects::KnownEffects(const Robot& robot, std::vector<KnownEffect> effects,
                           const MotionScale& scale, DryFriction friction)
    : effects_(std::move(effects)),
      scale_(scale),
      coulomb_(std::move(friction.coulomb)) {
  for (size_t e = 0; e < effects_.size(); ++e) {
    KnownEffect& known = effects_[e];
    for (int k = 0; k < known.p.size(); ++k) {
      const EffectParameter& parameter = known.effect->parameters[k];
      if (parameter.search != EffectParameter::Search::kLinear) continue;
      const double spread = std::max(
          std::abs(known.p[k]), parameter.size({&robot, known.joint, &scale_}));
      double dry = 0;
      for (const KnownEffect& law : friction.laws) {
        const bool same =
            law.effect == known.effect && law.joint == known.joint;
        if (same) dry = law.p[k] / spread;
      }
      parameters_.push_back({static_cast<int>(e), known.joint, k, spread, dry});
      known.p[k] = 0;
    }
  }
}

// Torque per unit of each parameter, by evaluating the law with that parameter
// alone: it is linear in them.
std::vector<MatrixXd> KnownEffects::Torques(const Robot& robot,
                                            RecordedTorque torque) const {
  std::vector<MatrixXd> torques;
  for (const Parameter& parameter : parameters_) {
    const KnownEffect& known = effects_[parameter.effect];
    VectorXd p = known.p;
    p[parameter.index] = parameter.spread;
    SimulatedRobot changed;
    changed.robot = robot;
    known.effect->apply({&robot, known.joint, &scale_}, p, &changed);
    torques.push_back(torque.Change(changed));
  }
  return torques;
}

std::vector<KnownEffect> KnownEffects::At(const VectorXd& values) const {
  CHECK_EQ(values.size(), static_cast<Eigen::Index>(parameters_.size()));
  std::vector<KnownEffect> effects = effects_;
  for (size_t k = 0; k < parameters_.size(); ++k) {
    const Parameter& parameter = parameters_[k];
    effects[parameter.effect].p[parameter.index] = values[k] * parameter.spread;
  }
  return effects;
}

}  // namespace armcal
